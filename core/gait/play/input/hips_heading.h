// Heading of a walk from its hips as they come live, and the hips without it
// (docs/design.md, Words: hips, heading): the facing direction averaged over the last cycle.
#pragma once

#include <Eigen/Geometry>

#include "gait/model/model.h"
#include "gait/motion/heading.h"

namespace gait {

class HipsHeading {
 public:
  // `frame_rate`: of the frames that will come, per second.
  HipsHeading(const Body& body, double frame_rate);

  // Takes a frame's hips, turned in the world. Returns the heading with this frame included
  // (radians).
  float advance(const Eigen::Quaternionf& hips) noexcept;
  void reset() noexcept { heading_.reset(); }

  // Which of the body's input joints is the hips; -1: they are not measured.
  static int input_of(const Body& body);

 private:
  CausalHeading<float> heading_;
  Eigen::Vector3f right_to_left_thigh_;  // in the hips' frame
};

}  // namespace gait
