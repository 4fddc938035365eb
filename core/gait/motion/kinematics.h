// Forward kinematics: from local rotations and translations to places in the world.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "gait/motion/clip.h"
#include "gait/motion/rotation.h"

namespace gait {

// A joint in the world, or against whatever its chain begins at.
template <typename Scalar>
struct Placement {
  Quaternion<Scalar> rotation = Quaternion<Scalar>::Identity();
  Vector3<Scalar> place = Vector3<Scalar>::Zero();
};

// Forward kinematics of one joint: where it is under its parent. `local`: its rotation in the
// parent's frame; `offset`: from the parent, in its frame; `scale`: how much longer bones are.
template <typename Scalar>
Placement<Scalar> placed_under(const Placement<Scalar>& parent, const Quaternion<Scalar>& local,
                               const Vector3<Scalar>& offset, Scalar scale = 1) noexcept {
  return {parent.rotation * local, parent.place + scale * (parent.rotation * offset)};
}

// Global rotation and position of every joint, in the unit of `translations`. All spans have one
// entry per joint of `skeleton`; the results are written in place, nothing is allocated.
void forward_kinematics(const Skeleton& skeleton, std::span<const Eigen::Quaterniond> rotations,
                        std::span<const Eigen::Vector3d> translations,
                        std::span<Eigen::Quaterniond> global_rotations,
                        std::span<Eigen::Vector3d> positions) noexcept;

// The same for every frame of a clip: frame after frame, one entry per joint.
struct WorldPoses {
  std::vector<Eigen::Quaterniond> rotations;
  std::vector<Eigen::Vector3d> positions;
};
WorldPoses world_poses(const Clip& clip);

}  // namespace gait
