#include "gait/corpus/corpus.h"

#include <algorithm>
#include <cmath>

#include "gait/error.h"

namespace gait {

CorpusWalk make_walk(const WalkPlan& plan, double frame_rate) {
  if (!(frame_rate > 0))
    throw Error("a frame rate must be above 0, not " + std::to_string(frame_rate));
  const SyntheticWalk drawn(plan);
  // A moment that falls on a frame but for rounding is on it.
  constexpr double rounding = 1e-9;

  CorpusWalk walk;
  walk.style = plan.style.name;
  walk.take = plan.take;
  walk.clip.name = "walk_" + walk.style + "_" + std::to_string(walk.take);
  walk.clip.skeleton = drawn.skeleton();
  walk.clip.frame_rate = frame_rate;
  const int frames = static_cast<int>(std::floor(drawn.duration() * frame_rate + rounding)) + 1;
  walk.clip.resize(frames);
  for (int frame = 0; frame < frames; ++frame) {
    const double time = frame / frame_rate;
    walk.clip.translation(frame)[0] = drawn.pose(time, walk.clip.pose(frame));
    walk.phase.push_back(drawn.phase(time));
  }
  for (const auto& contact : drawn.contacts()) {
    const double touch = contact.time * frame_rate;
    const int first = static_cast<int>(std::ceil(touch - rounding));
    walk.contacts.push_back({first, contact.foot, touch - first});
  }
  return walk;
}

std::vector<int> cycles_of_takes(int cycles) {
  const int takes = std::max(4, (cycles + 2) / 5);
  std::vector<int> of_takes(static_cast<std::size_t>(takes), cycles / takes);
  for (int i = 0; i < cycles % takes; ++i) ++of_takes[static_cast<std::size_t>(i)];
  return of_takes;
}

std::vector<CorpusWalk> make_corpus(std::uint64_t seed, double frame_rate) {
  std::vector<CorpusWalk> corpus;
  for (const WalkStyle& style : corpus_styles()) {
    int take = 0;
    for (const int cycles : cycles_of_takes(style.cycles)) {
      WalkPlan plan{.style = style, .cycles = cycles, .seed = seed, .take = ++take};
      corpus.push_back(make_walk(plan, frame_rate));
    }
  }
  return corpus;
}

}  // namespace gait
