// How fast joints turn, and how lively that is against what a model was taught.
//
// Energy is the root of the mean square over the model's joints, over a tenth of a second, as a
// share of the liveliest moment of the liveliest style in training (statics and deviations of the
// states' first differences): 0 at rest, 1 as lively as that or more. Nothing allocates after
// construction.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "gait/model/model.h"

namespace gait {

class MotionMeter {
 public:
  // The model must have a body.
  explicit MotionMeter(const Model& model);

  // Takes the next frame: local rotations, one per joint of the body.
  void advance(std::span<const Eigen::Quaternionf> pose) noexcept;
  float speed(int joint) const noexcept {
    return speeds_[static_cast<std::size_t>(joint)];
  }                                                  // rad/s
  float energy() const noexcept { return energy_; }  // 0 to 1
  void reset() noexcept;

 private:
  float rate_, share_, liveliest_;  // the last one: what energy 1 is, rad/s per joint
  std::vector<int> joints_;         // of the model's streams
  bool started_ = false;
  std::vector<Eigen::Quaternionf> before_;
  std::vector<float> speeds_;
  float squares_ = 0, energy_ = 0;
};

}  // namespace gait
