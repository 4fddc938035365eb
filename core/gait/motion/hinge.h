// Hinges: joints that bend about one axis, knees and elbows, and how far they do.
//
// A hinge's angle is that between the bone above it and the bone below it, seen along its axis: 0
// in line, above 0 the way it bends, below 0 the wrong way. Radians; bones and axis in the frame of
// the hinge's parent.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <span>
#include <vector>

#include "gait/motion/joint_roles.h"
#include "gait/motion/rotation.h"
#include "gait/motion/skeleton.h"

namespace gait {

struct Hinge {
  // Thigh, shank, foot; or arm, forearm, hand. Without a hand (-1) the forearm goes to its tip.
  int above = -1, joint = -1, below = -1;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  double least = 0, most = 0;  // range of the angle in the training data
};

// The knees and elbows among the roles, without axis and range: right knee, left knee, right elbow,
// left elbow.
std::vector<Hinge> find_hinges(const Skeleton& skeleton, const JointRoles& roles);

template <typename Scalar>
struct HingeBones {
  Vector3<Scalar> above, below;

  // About a unit axis, -π to π.
  Scalar angle(const Vector3<Scalar>& axis) const noexcept {
    const Scalar along = above.dot(axis) * below.dot(axis);
    return std::atan2(axis.dot(above.cross(below)), above.dot(below) - along);
  }
};

// Both bones of a hinge in a pose. `pose`: local rotations, one per joint. Joints in between are
// passed.
template <typename Scalar>
HingeBones<Scalar> hinge_bones(const Skeleton& skeleton, const Hinge& hinge,
                               std::span<const Quaternion<Scalar>> pose) noexcept {
  const auto offset = [&](int joint) {
    return Vector3<Scalar>(skeleton.joints[joint].offset.cast<Scalar>());
  };
  HingeBones<Scalar> bones{offset(hinge.joint), {}};
  Quaternion<Scalar> back = Quaternion<Scalar>::Identity();
  for (int at = skeleton.joints[hinge.joint].parent; at != hinge.above;
       at = skeleton.joints[at].parent) {
    back = back * pose[at].conjugate();
    bones.above += back * offset(at);
  }
  if (hinge.below < 0) {
    bones.below = skeleton.joints[hinge.joint].tips.front().cast<Scalar>();
  } else {
    bones.below = offset(hinge.below);
    for (int at = skeleton.joints[hinge.below].parent; at != hinge.joint;
         at = skeleton.joints[at].parent)
      bones.below = offset(at) + pose[at] * bones.below;
  }
  bones.below = pose[hinge.joint] * bones.below;
  return bones;
}

}  // namespace gait
