#include "gait/motion/humanoid_body.h"

#include <algorithm>
#include <cmath>

#include "gait/error.h"
#include "gait/motion/heading.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"

namespace gait {

namespace {

constexpr int spine_bone = index_of(Bone::spine), upper_chest = index_of(Bone::upper_chest);

}  // namespace

std::vector<Eigen::Quaterniond> usual_pose(const Clip& clip, const JointRoles& roles) {
  if (!roles.has_legs() || clip.frames() == 0)
    throw Error(clip.name + ": expected frames of a rig whose hips and legs are known");
  constexpr int most_frames = 1000;  // more would not change a mean
  const int stride = 1 + clip.frames() / most_frames;
  const std::size_t joints = clip.skeleton.joints.size();
  std::vector<std::vector<Eigen::Quaterniond>> seen(joints);
  std::vector<Eigen::Quaterniond> world(joints);
  std::vector<Eigen::Vector3d> places(joints);
  for (int frame = 0; frame < clip.frames(); frame += stride) {
    forward_kinematics(clip.skeleton, clip.pose(frame), clip.translation(frame), world, places);
    const Eigen::Vector3d across = places[roles.left.thigh] - places[roles.right.thigh];
    const double heading = heading_across(across);
    for (std::size_t joint = 0; joint < joints; ++joint)
      seen[joint].push_back(static_cast<int>(joint) == roles.hips
                                ? about_vertical(-heading) * world[joint]
                                : clip.pose(frame)[joint]);
  }
  std::vector<Eigen::Quaterniond> mean;
  for (const auto& rotations : seen) mean.push_back(chordal_mean(rotations));
  return mean;
}

HumanoidBody::HumanoidBody(const Skeleton& skeleton, const JointRoles& roles,
                           std::span<const Eigen::Quaterniond> usual)
    : skeleton_(skeleton),
      hips_(roles.hips),
      joints_(bones_of_joints(skeleton, roles.of_joint)),
      standing_(calibration_pose(skeleton, roles, usual, CalibrationPose::t)) {
  world_ = standing_;
  joint_of_.fill(-1);
  std::vector<int> spine_joints;
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    int above = skeleton.joints[joint].parent;
    while (above >= 0 && joints_[above].bone < 0) above = skeleton.joints[above].parent;
    above_.push_back(above);
    if (joints_[joint].bone == spine_bone)
      spine_joints.push_back(joint);
    else if (joints_[joint].bone >= 0)
      joint_of_[joints_[joint].bone] = joint;  // of several, the last
  }
  // The three bones of the spine are read from its lowest, middle and highest joint.
  if (!spine_joints.empty()) joint_of_[spine_bone] = spine_joints.front();
  if (spine_joints.size() == 2) joint_of_[spine_bone + 1] = spine_joints[1];
  if (spine_joints.size() > 2) {
    joint_of_[spine_bone + 1] = spine_joints[spine_joints.size() / 2];
    joint_of_[upper_chest] = spine_joints.back();
  }
  read(standing_, {}, t_pose_);
  read(calibration_pose(skeleton, roles, usual, CalibrationPose::i), {}, i_pose_);
}

void HumanoidBody::read(std::span<const Eigen::Quaterniond> world,
                        std::span<const Eigen::Vector3d> places,
                        HumanoidPose& pose) const noexcept {
  pose.clear();
  for (int bone = 0; bone < humanoid_bones; ++bone) {
    const int joint = joint_of_[static_cast<std::size_t>(bone)];
    if (joint < 0) continue;
    const auto at = static_cast<std::size_t>(bone);
    pose.turned.set(at);
    pose.turns[at] = world[joint] * standing_[joint].conjugate();
    if (places.empty()) continue;
    pose.placed.set(at);
    pose.places[at] = places[joint];
  }
}

// Treats the sender's spine as one turn from the hips up, whatever its number of bones.
bool HumanoidBody::spine_turn(const HumanoidPose& pose, double share,
                              Eigen::Quaterniond& turn) const noexcept {
  int count = 0;
  for (int bone = spine_bone; bone <= upper_chest; ++bone) count += pose.turned[bone] ? 1 : 0;
  if (count == 0 || !pose.turned[index_of(Bone::hips)]) return false;
  const double place = share * count;
  const int below = std::min(static_cast<int>(place + 1e-9), count);
  Eigen::Quaterniond ends[2] = {pose.turns[index_of(Bone::hips)], pose.turns[index_of(Bone::hips)]};
  for (int bone = spine_bone, seen = 0; bone <= upper_chest; ++bone) {
    if (!pose.turned[bone]) continue;
    ++seen;
    if (seen == below) ends[0] = pose.turns[bone];
    if (seen == below + 1) ends[1] = pose.turns[bone];
  }
  const double rest = place - below;
  turn = rest > 1e-9 ? slerp(ends[0], ends[1], rest) : ends[0];
  return true;
}

bool HumanoidBody::turn_of(const HumanoidPose& pose, int joint,
                           Eigen::Quaterniond& turn) const noexcept {
  const JointBone& of = joints_[joint];
  if (of.bone < 0) return false;
  if (of.bone == spine_bone) return spine_turn(pose, of.share, turn);
  if (!pose.turned[of.bone]) return false;
  turn = pose.turns[of.bone];
  if (of.share < 1) {
    const int above = pose.turned_above(of.bone);
    if (above >= 0) turn = slerp(pose.turns[above], turn, of.share);
  }
  return true;
}

void HumanoidBody::drive(const HumanoidPose& pose, std::span<Eigen::Quaterniond> local) noexcept {
  for (int joint = 0; joint < skeleton_.size(); ++joint) {
    const int parent = skeleton_.joints[joint].parent;
    Eigen::Quaterniond turn;
    if (turn_of(pose, joint, turn))
      world_[joint] = turn * standing_[joint];
    else if (parent >= 0)
      world_[joint] = world_[parent] * (standing_[parent].conjugate() * standing_[joint]);
    else
      world_[joint] = standing_[joint];
    local[joint] =
        joint == hips_ || parent < 0 ? world_[joint] : world_[parent].conjugate() * world_[joint];
  }
}

bool HumanoidBody::driven(const HumanoidPose& pose, int joint) const noexcept {
  Eigen::Quaterniond ignored;
  if (!turn_of(pose, joint, ignored)) return false;
  if (joint == hips_) return true;
  // Joints without a bone are passed; a bone above whose turn is not known leaves this one unknown.
  return above_[joint] < 0 || above_[joint] == hips_ ? pose.turned[index_of(Bone::hips)]
                                                     : turn_of(pose, above_[joint], ignored);
}

}  // namespace gait
