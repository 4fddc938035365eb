// What a recogniser tells a map about one frame, as a row of numbers that travels on a cord:
//
//   LAG  K s1 w1 ... sK wK  M m1 ... mM  D x1 ... xD
//
// LAG frames by which the decision is late; K states, counted over all labels, with their weights;
// M input values that are missing, by index; D leading entries of the observation that are real, in
// the streams' own units: statics, then the differences, as InputLayout has them. It needs nothing
// from earlier rows.
#pragma once

#include <span>
#include <vector>

#include "gait/model/model.h"
#include "gait/play/recognise/decoder.h"
#include "gait/play/recognise/recogniser.h"

namespace gait {

class ObservationMessage {
 public:
  explicit ObservationMessage(const Model& model);

  // The row for the frame that was decided on last; valid until the next call.
  std::span<const float> write(const Recogniser& recogniser) noexcept;

  // Reads a row. Null when it is one of this model's; else, with nothing changed, what was expected
  // of it.
  const char* read(std::span<const float> row) noexcept;

  // Of the row read last.
  int lag() const noexcept { return lag_; }
  std::span<const WeightedState> states() const noexcept {
    return {states_.data(), static_cast<std::size_t>(state_count_)};
  }
  std::span<const int> missing() const noexcept {
    return {missing_.data(), static_cast<std::size_t>(missing_count_)};
  }
  std::span<const float> observation() const noexcept {
    return {observation_.data(), static_cast<std::size_t>(known_)};
  }

  int longest() const noexcept { return static_cast<int>(row_.size()); }  // of rows

 private:
  InputLayout layout_;
  int model_states_;
  std::vector<float> row_;
  int lag_ = 0;
  std::vector<WeightedState> states_;
  int state_count_ = 0;
  std::vector<int> missing_;
  int missing_count_ = 0;
  std::vector<float> observation_;
  int known_ = 0;
};

}  // namespace gait
