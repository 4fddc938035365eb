#include <cmath>
#include <cstdio>

#include "gait/corpus/corpus.h"

namespace gait {

namespace {

constexpr double slowest = 0.6, speed_step = 0.2;  // m/s
constexpr int speeds = 8;                          // to 2 m/s
constexpr int cycles = 6;

// A foot pitches as far as the step it takes is long; the mean gait gives all else at its speed.
WalkStyle neutral_at(double speed_per_leg) {
  WalkStyle style = corpus_style("neutral");
  const double longer = std::pow(speed_per_leg / style.speed, 0.6);
  style.strike_pitch *= longer;
  style.push_pitch *= std::sqrt(longer);
  style.speed = speed_per_leg;
  return style;
}

}  // namespace

std::vector<CorpusWalk> make_speed_walks(std::uint64_t seed, double frame_rate) {
  std::vector<CorpusWalk> walks;
  for (int i = 0; i < speeds; ++i) {
    WalkPlan plan;
    const double speed = slowest + speed_step * i;
    plan.style = neutral_at(speed / plan.leg_length);
    plan.cycles = cycles, plan.seed = seed, plan.take = i + 1;
    CorpusWalk walk = make_walk(plan, frame_rate);
    walk.subject = walk.style;
    walk.speed = speed;
    walk.style.clear();
    char name[40];
    std::snprintf(name, sizeof name, "walk_%s_%.1f", walk.subject.c_str(), speed);
    walk.clip.name = name;
    walks.push_back(std::move(walk));
  }
  return walks;
}

}  // namespace gait
