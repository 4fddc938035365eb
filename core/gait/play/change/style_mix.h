// How much of each style a walk has, moving to where it was set within about one step: directly,
// or through a neutral walk on the way (T10 §9 names both).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "gait/play/change/glide.h"

namespace gait {

class StyleMix {
 public:
  // `can_walk`: per style; at least one must. `neutral`: weights of the neutral walk, sum 1. Starts
  // there.
  StyleMix(std::vector<bool> can_walk, const Eigen::VectorXf& neutral);

  // One weight per style, not negative; they are normalised. False, with nothing changed, when one
  // is negative, not finite, of a style that cannot walk, when all are zero or the size is another.
  bool set(std::span<const float> weights) noexcept;
  bool set_only(int style) noexcept;  // the whole weight on this one
  void set_through_neutral(bool through) noexcept { through_neutral_ = through; }

  void advance(float cycles) noexcept;  // by this much phase
  void arrive() noexcept;               // at once where it was set

  const Eigen::VectorXf& weights() const noexcept { return weights_; }  // sum 1

 private:
  void go(int strongest_before) noexcept;
  int strongest(const Eigen::VectorXf& weights) const noexcept;

  std::vector<bool> can_walk_;
  Eigen::VectorXf neutral_, wanted_, weights_;
  std::vector<Glide> glides_;
  bool through_neutral_ = false;
  float to_neutral_ = 0;    // cycles left until the way leads on from neutral
  float since_passed_ = 1;  // cycles since then
};

}  // namespace gait
