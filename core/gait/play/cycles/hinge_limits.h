// Hinge limits: a pose that was made bends no knee and no elbow further than anybody did whom the
// model learnt from, nor the wrong way.
//
// Means of poses, draws far from the mean and exaggeration all leave the range of what was seen;
// other joints may, a knee that bends backward is broken. Near its limit a hinge gives way little
// by little, so that it does not stop dead.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "gait/model/model.h"

namespace gait {

class HingeLimits {
 public:
  // Of the body's hinges; none, and poses stay as they are, in models of before there were any.
  explicit HingeLimits(const Body& body) : skeleton_(body.skeleton), hinges_(body.hinges) {}

  // `pose`: local rotations, one per joint of the body, finite.
  void apply(std::span<Eigen::Quaternionf> pose) const noexcept;

 private:
  Skeleton skeleton_;
  std::vector<Hinge> hinges_;
};

}  // namespace gait
