// Humanoid body: a rig that can be told as a humanoid, and be driven by one.
//
// Both ways go by what each joint's rotation in the world is when the body stands in the T-pose,
// W0: a joint with rotation W has turned by W W0^-1, and one that has turned by D stands at D W0.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "gait/motion/calibration_pose.h"
#include "gait/motion/clip.h"
#include "gait/motion/humanoid.h"

namespace gait {

// The mean pose of a clip: local rotations, the hips' in the world with heading out. What
// calibration_pose and HumanoidBody want of a rig that no model speaks for. Needs legs and a frame.
std::vector<Eigen::Quaterniond> usual_pose(const Clip& clip, const JointRoles& roles);

class HumanoidBody {
 public:
  // `usual` as for calibration_pose. Skeleton in metres. Throws Error as that does.
  HumanoidBody(const Skeleton& skeleton, const JointRoles& roles,
               std::span<const Eigen::Quaterniond> usual);

  // Turns and places of the bones this rig has. `world`, `places`: per joint, rotation in the world
  // and place (metres); without places none are told.
  void read(std::span<const Eigen::Quaterniond> world, std::span<const Eigen::Vector3d> places,
            HumanoidPose& pose) const noexcept;

  // The rig's local rotations, the hips' in the world, from turns. What has no turn is at rest
  // against its parent, as in the T-pose.
  void drive(const HumanoidPose& pose, std::span<Eigen::Quaterniond> local) noexcept;
  // Whether a joint's rotation says something of this pose: its bone and the one its parent goes by
  // are turned.
  bool driven(const HumanoidPose& pose, int joint) const noexcept;

  // Turns of the bones from T-pose to this calibration pose: what a sender that stands in it has
  // turned by.
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
