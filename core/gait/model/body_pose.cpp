#include "gait/model/body_pose.h"

#include <algorithm>

#include "gait/error.h"
#include "gait/motion/heading.h"
#include "gait/motion/kinematics.h"

namespace gait {

namespace {

// The direction in which a joint's bone leaves its parent; nothing for joints that sit on it.
bool rest_directions_differ(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double shortest = 0.01;  // metres; shorter bones have no direction to speak of
  if (a.norm() < shortest || b.norm() < shortest) return false;
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)) >
         rest_direction_limit;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

std::vector<int> match_joints(const Body& body, const Skeleton& skeleton, const std::string& clip,
                              const std::vector<int>& needed) {
  std::vector<int> wanted = needed;
  if (wanted.empty())
    for (int joint = 0; joint < body.skeleton.size(); ++joint) wanted.push_back(joint);
  std::vector<int> matched(body.skeleton.size(), -1);
  std::vector<std::string> missing, turned;
  for (int joint = 0; joint < body.skeleton.size(); ++joint)
    matched[joint] = skeleton.find(body.skeleton.joints[joint].name);
  for (const int joint : wanted) {
    const Joint& mine = body.skeleton.joints[joint];
    if (matched[joint] < 0)
      missing.push_back(mine.name);
    else if (mine.parent >= 0 && body.roles[joint] != Role::hips &&
             rest_directions_differ(mine.offset, skeleton.joints[matched[joint]].offset))
      turned.push_back(mine.name);
  }
  if (!missing.empty())
    throw Error(clip + ": expected the model's joints; missing: " + listed(missing));
  if (!turned.empty())
    throw Error(clip + ": expected bones that rest as the model's do, within 10 degrees; these " +
                "differ: " + listed(turned));
  return matched;
}

BodyPoses body_poses(const Clip& clip, const Body& body, const std::vector<int>& matched,
                     double cycle_seconds) {
  BodyPoses poses;
  poses.joints = body.skeleton.size();
  poses.rotations.resize(static_cast<std::size_t>(clip.frames()) * poses.joints);
  JointRoles roles;
  roles.of_joint.assign(clip.skeleton.size(), Role::none);
  const auto find = [&](Role role) {
    for (int joint = 0; joint < poses.joints; ++joint)
      if (body.roles[joint] == role) return matched[joint];
    return -1;
  };
  roles.hips = find(Role::hips);
  roles.left.thigh = find(Role::left_thigh);
  roles.right.thigh = find(Role::right_thigh);
  roles.left.shank = find(Role::left_shank);
  roles.left.foot = find(Role::left_foot);

  const WorldPoses world = world_poses(clip);
  const int joints = clip.skeleton.size();
  poses.heading.assign(clip.frames(), 0.0);
  const bool legs = roles.hips >= 0 && roles.left.thigh >= 0 && roles.right.thigh >= 0 &&
                    roles.left.shank >= 0 && roles.left.foot >= 0;
  const bool hips_measured =
      std::any_of(body.input_joints.begin(), body.input_joints.end(),
                  [&](int joint) { return body.roles[joint] == Role::hips; });
  if (legs && hips_measured) {
    CausalHeading<double> causal(
        static_cast<int>(std::lround(body.heading_window * clip.frame_rate)));
    for (int frame = 0; frame < clip.frames(); ++frame) {
      const auto* at = &world.positions[static_cast<std::size_t>(frame) * joints];
      poses.heading[frame] = causal.advance(at[roles.left.thigh] - at[roles.right.thigh]);
    }
  } else if (legs && clip.frames() > 1) {
    poses.heading = centred_heading(world, roles, joints, clip.frame_rate, cycle_seconds);
  }
  for (int frame = 0; frame < clip.frames(); ++frame)
    for (int joint = 0; joint < poses.joints; ++joint) {
      Eigen::Quaterniond& rotation =
          poses.rotations[static_cast<std::size_t>(frame) * poses.joints + joint];
      if (matched[joint] < 0)
        rotation =
            body.references.empty() ? Eigen::Quaterniond::Identity() : body.references[joint];
      else if (matched[joint] == roles.hips)
        rotation = about_vertical(-poses.heading[frame]) *
                   world.rotations[static_cast<std::size_t>(frame) * joints + roles.hips];
      else
        rotation = clip.pose(frame)[matched[joint]];
    }
  return poses;
}

}  // namespace gait
