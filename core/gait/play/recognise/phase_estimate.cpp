#include "gait/play/recognise/phase_estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gait {

namespace {

// In [0, 1), also where float rounds up to 1.
float wrapped(float phase) noexcept {
  phase -= std::floor(phase);
  return phase < 1 ? phase : 0.0f;
}

}  // namespace

PhaseEstimator::PhaseEstimator(const Model& model) : cycles_(label_cycles(model)) {
  for (std::size_t label = 0; label < model.labels.size(); ++label) {
    const LabelCycle& cycle = cycles_[label];
    const double duration = mean_duration(model.labels[label]);
    double before = 0;
    for (const State& state : model.labels[label].states) {
      const double share = duration > 0 ? (before + 0.5 * state.duration) / duration : 0.5;
      label_of_.push_back(static_cast<int>(label));
      middle_.push_back(static_cast<float>((cycle.index + share) / cycle.labels));
      before += state.duration;
    }
  }
  age_ = static_cast<float>(model.input.mean_age() / model.frame_rate);
}

PhaseEstimate PhaseEstimator::estimate(const LabelCycle& cycle, float phase,
                                       float certainty) const noexcept {
  return {wrapped(phase), certainty, wrapped(phase - cycle.frequency * age_), age_};
}

// The circular mean of the states' phases; `phase_of` says each by its number in the span.
PhaseEstimator::Mean PhaseEstimator::mean_of(std::span<const WeightedState> states,
                                             auto phase_of) const noexcept {
  constexpr float turn = 2 * std::numbers::pi_v<float>;
  const int ring = cycles_[label_of_[states.front().state]].ring;
  float x = 0, y = 0, total = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    total += states[i].weight;
    // Phases of another ring say nothing about this one.
    if (cycles_[label_of_[states[i].state]].ring != ring) continue;
    x += states[i].weight * std::cos(turn * phase_of(i));
    y += states[i].weight * std::sin(turn * phase_of(i));
  }
  return {std::atan2(y, x) / turn, std::min(1.0f, std::hypot(x, y) / total)};
}

PhaseEstimate PhaseEstimator::of(std::span<const WeightedState> states,
                                 float progress) const noexcept {
  if (states.empty()) return {};
  const LabelCycle& cycle = cycles_[label_of_[states.front().state]];
  if (states.size() == 1)
    return estimate(cycle,
                    (static_cast<float>(cycle.index) + std::min(progress, 0.999f)) /
                        static_cast<float>(cycle.labels),
                    1);
  const Mean mean = mean_of(states, [&](std::size_t i) { return middle_[states[i].state]; });
  return estimate(cycle, mean.phase, mean.certainty);
}

PhaseEstimate PhaseEstimator::of(std::span<const WeightedState> states, float progress,
                                 std::span<const float> seen) const noexcept {
  PhaseEstimate estimate = of(states, progress);
  if (!states.empty())
    estimate.seen = wrapped(mean_of(states, [&](auto i) { return seen[i]; }).phase);
  return estimate;
}

}  // namespace gait
