// A walk whose phase is known, seen through noisy estimates, and a phase clock that runs beside it
// on stage: blocks of 64 samples at 48 kHz.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "gait/play/recognise/phase_clock.h"

namespace gait::testing {

// Cycles walked by a time, for a frequency (cycles/s) that changes at given times.
class KnownWalk {
 public:
  struct Change {
    double time, frequency;
  };
  explicit KnownWalk(std::vector<Change> changes) : changes_(std::move(changes)) {}

  double cycles(double time) const {
    double sum = 0.137;  // walks do not begin at a contact
    for (std::size_t i = 0; i < changes_.size(); ++i) {
      const double end = i + 1 < changes_.size() ? std::min(time, changes_[i + 1].time) : time;
      if (end > changes_[i].time) sum += (end - changes_[i].time) * changes_[i].frequency;
    }
    return sum;
  }

 private:
  std::vector<Change> changes_;
};

struct StageEvent {
  double time;  // when it arrives, seconds
  std::function<void(PhaseClock&)> act;
};

struct StageRecord {
  struct Contact {
    double time;
    int step;
  };
  std::vector<float> phase;  // per sample
  std::vector<Contact> contacts;
};

inline constexpr double stage_rate = 48000;
inline constexpr int stage_block = 64;

inline StageRecord play(PhaseClock& clock, std::vector<StageEvent> events, double seconds) {
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  StageRecord record;
  std::vector<float> block(stage_block);
  std::size_t next = 0;
  for (long sample = 0; sample < static_cast<long>(seconds * stage_rate); sample += stage_block) {
    // As in Pd, messages are heard between blocks.
    while (next < events.size() && events[next].time * stage_rate <= static_cast<double>(sample))
      events[next++].act(clock);
    clock.process(block, stage_rate);
    record.phase.insert(record.phase.end(), block.begin(), block.end());
    for (const auto& crossing : clock.crossings())
      record.contacts.push_back(
          {static_cast<double>(sample + crossing.sample) / stage_rate, crossing.step});
  }
  return record;
}

// How a walk is seen.
struct Sight {
  double noise = 0.02;  // deviation, cycles; what is seen wrong stays wrong for some frames
  double jitter = 0;    // seconds that frames arrive early or late, at most
  double lost = 0;      // share of frames that never arrive
  double late = 0;      // seconds by which estimates are known to be late
  double frame_rate = 30;
  unsigned seed = 1;
};

inline std::vector<StageEvent> estimates_of(const KnownWalk& walk, double begin, double end,
                                            const Sight& sight) {
  std::mt19937 random(sight.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<StageEvent> events;
  double wrong = 0;
  const double kept = 0.7;
  for (int frame = 0; frame < (end - begin) * sight.frame_rate; ++frame) {
    const double time = begin + frame / sight.frame_rate;
    wrong = kept * wrong + std::sqrt(1 - kept * kept) * sight.noise * normal(random);
    const double cycles = walk.cycles(time - sight.late) + wrong;
    const double arrival = time + sight.jitter * (2 * uniform(random) - 1);
    if (uniform(random) < sight.lost) continue;
    events.push_back({arrival, [phase = cycles - std::floor(cycles), late = sight.late](
                                   PhaseClock& clock) { clock.observe(phase, 1, late); }});
  }
  return events;
}

inline double wrapped_error(double phase, double cycles) {
  return std::remainder(phase - cycles, 1.0);
}

// Of the ramp against the walk, cycles.
inline double rms_error(const StageRecord& record, const KnownWalk& walk, double begin,
                        double end) {
  double sum = 0;
  long count = 0;
  for (long i = static_cast<long>(begin * stage_rate); i < static_cast<long>(end * stage_rate);
       i += 16, ++count) {
    const double error =
        wrapped_error(record.phase[i], walk.cycles(static_cast<double>(i + 1) / stage_rate));
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(count));
}

// The largest step from sample to sample over the mean one; negative when it ran backwards.
inline double steepest_step(const StageRecord& record, double begin, double end) {
  const auto first = static_cast<std::size_t>(begin * stage_rate);
  const auto last = static_cast<std::size_t>(end * stage_rate);
  double sum = 0, largest = 0, least = 0;
  for (std::size_t i = first + 1; i < last; ++i) {
    double step = static_cast<double>(record.phase[i]) - record.phase[i - 1];
    if (step < -0.5) step += 1;
    sum += step;
    largest = std::max(largest, step);
    least = std::min(least, step);
  }
  return least < 0 ? least : largest / (sum / static_cast<double>(last - first - 1));
}

// The contacts a walk really makes between two times.
inline std::vector<StageRecord::Contact> true_contacts(const KnownWalk& walk, double begin,
                                                       double end) {
  std::vector<StageRecord::Contact> contacts;
  const double dt = 1e-4;
  for (double time = begin; time < end; time += dt) {
    const double before = std::floor(2 * walk.cycles(time)),
                 after = std::floor(2 * walk.cycles(time + dt));
    if (after > before) contacts.push_back({time, static_cast<int>(after) % 2});
  }
  return contacts;
}

inline void expect_right_and_left_in_turn(const StageRecord& record) {
  for (std::size_t i = 1; i < record.contacts.size(); ++i)
    EXPECT_NE(record.contacts[i].step, record.contacts[i - 1].step) << record.contacts[i].time;
}

}  // namespace gait::testing
