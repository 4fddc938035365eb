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
  double halves = 0;
  for (const int lag : model.input.lags) halves += 0.5 * lag / model.frame_rate;
  age_ = static_cast<float>(halves / static_cast<double>(1 + model.input.lags.size()));
}

PhaseEstimate PhaseEstimator::estimate(const LabelCycle& cycle, float phase,
                                       float certainty) const noexcept {
  return {wrapped(phase), certainty, wrapped(phase - cycle.frequency * age_), age_};
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
  constexpr float turn = 2 * std::numbers::pi_v<float>;
  float x = 0, y = 0, total = 0;
  for (const WeightedState& state : states) {
    total += state.weight;
    // Phases of another ring say nothing about this one.
    if (cycles_[label_of_[state.state]].ring != cycle.ring) continue;
    x += state.weight * std::cos(turn * middle_[state.state]);
    y += state.weight * std::sin(turn * middle_[state.state]);
  }
  return estimate(cycle, std::atan2(y, x) / turn, std::min(1.0f, std::hypot(x, y) / total));
}

}  // namespace gait
