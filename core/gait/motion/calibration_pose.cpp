#include "gait/motion/calibration_pose.h"

#include <cmath>
#include <optional>

#include "gait/error.h"
#include "gait/motion/heading.h"
#include "gait/motion/rotation.h"

namespace gait {

namespace {

constexpr double shortest_bone = 0.01;  // metres; shorter ones have no direction to speak of

// Direction of a limb's bone in the pose; nothing for joints that are not swung.
std::optional<Eigen::Vector3d> direction_of(Role role, CalibrationPose pose) {
  const bool out = pose == CalibrationPose::t;
  switch (role) {
    case Role::left_arm:
    case Role::left_forearm:
    case Role::left_hand:
      return out ? Eigen::Vector3d(1, 0, 0) : Eigen::Vector3d(0, -1, 0);
    case Role::right_arm:
    case Role::right_forearm:
    case Role::right_hand:
      return out ? Eigen::Vector3d(-1, 0, 0) : Eigen::Vector3d(0, -1, 0);
    case Role::left_thigh:
    case Role::left_shank:
    case Role::right_thigh:
    case Role::right_shank:
      return Eigen::Vector3d(0, -1, 0);
    default:
      return std::nullopt;
  }
}

// Vector from a joint to the next joint of its limb, in the joint's frame; joints without a role in
// between are passed.
Eigen::Vector3d limb_of(const Skeleton& skeleton, const JointRoles& roles, int joint) {
  const Role role = roles.of_joint[joint];
  const bool hand = role == Role::left_hand || role == Role::right_hand;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int below = joint + 1; !hand && below < skeleton.size(); ++below) {
    if (roles.of_joint[below] != static_cast<Role>(static_cast<int>(role) + 1)) continue;
    int above = skeleton.joints[below].parent;
    while (above > joint && roles.of_joint[above] == Role::none)
      above = skeleton.joints[above].parent;
    if (above == joint) return skeleton.place_at_rest(below, joint);
  }
  for (const Joint& child : skeleton.joints)
    if (child.parent == joint) mean += child.offset;
  for (const Eigen::Vector3d& tip : skeleton.joints[joint].tips) mean += tip;
  return mean;
}

Eigen::Vector3d place_at(const Skeleton& skeleton, std::span<const Eigen::Quaterniond> world,
                         int joint) {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (; joint >= 0 && skeleton.joints[joint].parent >= 0; joint = skeleton.joints[joint].parent)
    place += world[skeleton.joints[joint].parent] * skeleton.joints[joint].offset;
  return place;
}

}  // namespace

std::vector<Eigen::Quaterniond> calibration_pose(const Skeleton& skeleton, const JointRoles& roles,
                                                 std::span<const Eigen::Quaterniond> usual,
                                                 CalibrationPose pose) {
  if (!roles.has_legs())
    throw Error("expected a rig whose hips and legs are known, to stand in a calibration pose");
  std::vector<Eigen::Quaterniond> world(usual.begin(), usual.end());
  // Joints above the hips carry the walk through the world; they are no part of the body's pose.
  const auto stand = [&](const Eigen::Quaterniond& turn) {
    for (int joint = 0; joint < skeleton.size(); ++joint) {
      const int parent = skeleton.joints[joint].parent;
      if (joint == roles.hips)
        world[joint] = turn * usual[joint];
      else if (parent >= 0)
        world[joint] = world[parent] * usual[joint];
    }
  };
  stand(Eigen::Quaterniond::Identity());
  const Eigen::Vector3d across =
      place_at(skeleton, world, roles.left.thigh) - place_at(skeleton, world, roles.right.thigh);
  const double heading = heading_across(across);
  stand(about_vertical(-heading));

  for (int joint = 0; joint < skeleton.size(); ++joint) {
    const int parent = skeleton.joints[joint].parent;
    if (joint != roles.hips && parent >= 0) world[joint] = world[parent] * usual[joint];
    const auto wanted = direction_of(roles.of_joint[joint], pose);
    if (!wanted) continue;
    const Eigen::Vector3d limb = limb_of(skeleton, roles, joint);
    if (limb.norm() < shortest_bone) continue;
    world[joint] = turn_between(world[joint] * limb, *wanted) * world[joint];
  }
  return world;
}

}  // namespace gait
