// Humanoid body: conversion between the pose of a rig and the turns of a humanoid.
//
// W0 is a joint's rotation in the world when the body stands in the T-pose. A joint with rotation W
// has turned by D = W W0^-1; a joint that has turned by D has rotation D W0.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "gait/motion/calibration_pose.h"
#include "gait/motion/clip.h"
#include "gait/motion/humanoid.h"

namespace gait {

// The mean pose of a clip: local rotations, the hips' in the world without heading. It is the
// `usual` pose for calibration_pose and HumanoidBody of a rig without a model. The clip needs legs
// and at least one frame.
std::vector<Eigen::Quaterniond> usual_pose(const Clip& clip, const JointRoles& roles);

class HumanoidBody {
 public:
  // `usual` as for calibration_pose. Skeleton in metres. Throws Error as that does.
  HumanoidBody(const Skeleton& skeleton, const JointRoles& roles,
               std::span<const Eigen::Quaterniond> usual);

  // Reads the turns and places of the bones that this rig has. `world`, `places`: per joint its
  // rotation in the world and its place (metres); with empty `places` no place is set.
  void read(std::span<const Eigen::Quaterniond> world, std::span<const Eigen::Vector3d> places,
            HumanoidPose& pose) const noexcept;

  // Sets the rig's local rotations, the hips' in the world, from turns. A joint without a turn has
  // the rotation relative to its parent that it has in the T-pose.
  void drive(const HumanoidPose& pose, std::span<Eigen::Quaterniond> local) noexcept;
  // Whether a joint's rotation is determined by this pose: its own bone and the bone of its parent
  // are turned.
  bool driven(const HumanoidPose& pose, int joint) const noexcept;

  // Turns of the bones from the T-pose to this calibration pose.
  const HumanoidPose& calibration(CalibrationPose pose) const noexcept {
    return pose == CalibrationPose::t ? t_pose_ : i_pose_;
  }
  const Skeleton& skeleton() const noexcept { return skeleton_; }
  const std::vector<JointBone>& joints() const noexcept { return joints_; }

 private:
  // The turn a joint takes of a pose; false when it takes none.
  bool turn_of(const HumanoidPose& pose, int joint, Eigen::Quaterniond& turn) const noexcept;
  bool spine_turn(const HumanoidPose& pose, double share, Eigen::Quaterniond& turn) const noexcept;

  Skeleton skeleton_;
  int hips_;
  std::vector<JointBone> joints_;
  std::vector<int> above_;                    // the nearest joint above with a bone, -1: none
  std::array<int, humanoid_bones> joint_of_;  // which joint a bone is read from, -1: none
  std::vector<Eigen::Quaterniond> standing_;  // W0
  std::vector<Eigen::Quaterniond> world_;     // while driving
  HumanoidPose t_pose_, i_pose_;
};

}  // namespace gait
