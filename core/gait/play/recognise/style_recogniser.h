// Style recogniser: how one walks, from linear discriminants in each state (one mean per style, one
// covariance shared by all of them).
//
// A frame's scores are averaged over about a second by a leak, and tempered: neighbouring frames
// say nearly the same, so their evidence must not add up as if they were independent.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "gait/play/recognise/decoder.h"
#include "gait/play/recognise/emissions.h"

namespace gait {

class StyleRecogniser {
 public:
  // The temper is the model's, the memory too until it is set.
  StyleRecogniser(const Model& model, std::shared_ptr<const StateTables> tables);

  // Takes the scaled observation `x`, of which `known` leading entries are real, in the states that
  // were decided.
  void advance(std::span<const WeightedState> states, const Eigen::Ref<const Eigen::VectorXf>& x,
               int known) noexcept;

  // One per style, sums to one; empty for models without styles.
  std::span<const float> posteriors() const noexcept {
    return {posteriors_.data(), static_cast<std::size_t>(posteriors_.size())};
  }
  int best() const noexcept { return best_; }  // -1 without styles

  void set_memory(float seconds) noexcept;
  void use(const std::shared_ptr<const StateTables>& tables) noexcept { tables_ = tables; }
  void reset() noexcept;

 private:
  std::shared_ptr<const StateTables> tables_;
  InputLayout layout_;
  Whitening kept_;
  Eigen::VectorXf score_, scores_, averaged_, posteriors_;
  double frame_rate_;
  float keep_ = 0, temper_ = 1;
  int best_ = -1;
};

}  // namespace gait
