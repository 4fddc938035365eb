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

PhaseEstimator::PhaseEstimator(const Model& model) {
  const std::vector<Label>& labels = model.labels;
  const int count = static_cast<int>(labels.size());
  std::vector<double> duration(labels.size(), 0.0);
  for (int label = 0; label < count; ++label)
    for (const State& state : labels[label].states) duration[label] += state.duration;

  for (int label = 0; label < count; ++label) {
    Place place{label, 0, 1, 0};
    int first = label, length = 0, labels_to_first = 0;
    double seconds = 0;
    for (int at = label; length <= count;) {
      if (labels[at].successors.size() != 1) {
        length = 0;
        break;
      }
      seconds += duration[at];
      at = labels[at].successors.front();
      ++length;
      if (at == label) break;
      if (at < first) first = at, labels_to_first = length;
    }
    // A walk that never came back to the label has run longer than there are labels.
    if (length > 0 && length <= count)
      place = {first, (length - labels_to_first) % length, length, 0};
    else
      seconds = duration[label];
    place.frequency = seconds > 0 ? static_cast<float>(1 / seconds) : 0.0f;
    places_.push_back(place);

    double before = 0;
    for (const State& state : labels[label].states) {
      const double share =
          duration[label] > 0 ? (before + 0.5 * state.duration) / duration[label] : 0.5;
      label_of_.push_back(label);
      middle_.push_back(static_cast<float>((place.index + share) / place.of));
      before += state.duration;
    }
  }
  double halves = 0;
  for (const int lag : model.input.lags) halves += 0.5 * lag / model.frame_rate;
  age_ = static_cast<float>(halves / static_cast<double>(1 + model.input.lags.size()));
}

PhaseEstimate PhaseEstimator::estimate(const Place& place, float phase,
                                       float certainty) const noexcept {
  return {wrapped(phase), certainty, wrapped(phase - place.frequency * age_), age_};
}

PhaseEstimate PhaseEstimator::of(std::span<const WeightedState> states,
                                 float progress) const noexcept {
  if (states.empty()) return {};
  const Place& place = places_[label_of_[states.front().state]];
  if (states.size() == 1)
    return estimate(place,
                    (static_cast<float>(place.index) + std::min(progress, 0.999f)) /
                        static_cast<float>(place.of),
                    1);
  constexpr float turn = 2 * std::numbers::pi_v<float>;
  float x = 0, y = 0, total = 0;
  for (const WeightedState& state : states) {
    total += state.weight;
    // Phases of another ring say nothing about this one.
    if (places_[label_of_[state.state]].ring != place.ring) continue;
    x += state.weight * std::cos(turn * middle_[state.state]);
    y += state.weight * std::sin(turn * middle_[state.state]);
  }
  return estimate(place, std::atan2(y, x) / turn, std::min(1.0f, std::hypot(x, y) / total));
}

}  // namespace gait
