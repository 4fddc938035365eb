#include "gait/model/body_pose.h"

#include <algorithm>

#include "gait/error.h"
#include "gait/motion/heading.h"
#include "gait/motion/kinematics.h"
#include "gait/names.h"

namespace gait {

namespace {

// The direction in which a joint's bone leaves its parent; nothing for joints that sit on it.
bool rest_directions_differ(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double limit) {
  const double shortest = 0.01;  // metres; shorter bones have no direction to speak of
  if (a.norm() < shortest || b.norm() < shortest) return false;
  return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)) > limit;
}

// The bone that ends in such a joint is part of a person's shape.
double rest_limit(Role role) {
  switch (role) {
    case Role::spine:
    case Role::neck:
    case Role::head:
    case Role::left_shoulder:
    case Role::right_shoulder:
    case Role::left_arm:
    case Role::right_arm:
    case Role::left_thigh:
    case Role::right_thigh:
      return shape_direction_limit;
    default:
      return rest_direction_limit;
  }
}

}  // namespace

const Body& required_body(const Model& model) {
  if (!model.body)
    throw Error("model " + model.name + ": expected a model of a body; its streams are plain");
  return *model.body;
}

std::vector<Eigen::Quaternionf> float_references(const Body& body) {
  std::vector<Eigen::Quaternionf> references;
  for (const Eigen::Quaterniond& reference : body.references)
    references.push_back(reference.cast<float>());
  return references;
}

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
             rest_directions_differ(mine.offset, skeleton.joints[matched[joint]].offset,
                                    rest_limit(body.roles[joint])))
      turned.push_back(mine.name);
  }
  if (!missing.empty())
    throw Error(clip + ": expected the model's joints; missing: " + joined_names(missing));
  if (!turned.empty())
    throw Error(clip + ": expected bones that rest as the model's do (limbs within 10 " +
                "degrees, trunk and head within 35); these differ: " + joined_names(turned));
  return matched;
}

BodyPoses body_poses(const Clip& clip, const Body& body, const std::vector<int>& matched,
                     double cycle_seconds) {
  BodyPoses poses;
  poses.joints = body.skeleton.size();
  poses.rotations.resize(static_cast<std::size_t>(clip.frames()) * poses.joints);
  const JointRoles roles = matched_roles(body, matched, clip.skeleton.size());

  const WorldPoses world = world_poses(clip);
  const int joints = clip.skeleton.size();
  poses.heading.assign(clip.frames(), 0.0);
  const bool legs = roles.has_legs();
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

JointRoles body_roles(const Body& body) {
  JointRoles roles;
  roles.of_joint = body.roles;
  roles.hips = roles.joint(Role::hips);
  roles.left = {roles.joint(Role::left_thigh), roles.joint(Role::left_shank),
                roles.joint(Role::left_foot), roles.joint(Role::left_toes)};
  roles.right = {roles.joint(Role::right_thigh), roles.joint(Role::right_shank),
                 roles.joint(Role::right_foot), roles.joint(Role::right_toes)};
  return roles;
}

RoleTable hips_and_legs_of(const Body& body) {
  RoleTable table;
  for (int joint = 0; joint < body.skeleton.size(); ++joint)
    if (const Role role = body.roles[joint]; role == Role::hips || role >= Role::left_thigh)
      table.emplace(body.skeleton.joints[joint].name, role);
  return table;
}

JointRoles matched_roles(const Body& body, const std::vector<int>& matched, int clip_joints) {
  const auto in_clip = [&](int joint) { return joint < 0 ? -1 : matched[joint]; };
  const auto leg = [&](const Leg& of) {
    return Leg{in_clip(of.thigh), in_clip(of.shank), in_clip(of.foot), in_clip(of.toes)};
  };
  const JointRoles mine = body_roles(body);
  JointRoles roles;
  roles.of_joint.assign(clip_joints, Role::none);
  for (std::size_t joint = 0; joint < matched.size(); ++joint)
    if (matched[joint] >= 0) roles.of_joint[matched[joint]] = body.roles[joint];
  roles.hips = in_clip(mine.hips);
  roles.left = leg(mine.left);
  roles.right = leg(mine.right);
  return roles;
}

Clip body_clip(const Body& body, const std::string& name, double frame_rate, int frames) {
  Clip clip;
  clip.name = name;
  clip.skeleton = body.skeleton;
  clip.frame_rate = frame_rate;
  clip.resize(frames);
  return clip;
}

void place_body(Clip& clip, int frame, const JointRoles& roles,
                std::span<const Eigen::Quaterniond> pose, double heading,
                const Eigen::Vector3d& hips) {
  std::copy(pose.begin(), pose.end(), clip.pose(frame).begin());
  for (int above = clip.skeleton.joints[roles.hips].parent; above >= 0;
       above = clip.skeleton.joints[above].parent) {
    clip.pose(frame)[above].setIdentity();
    clip.translation(frame)[above].setZero();
  }
  clip.pose(frame)[roles.hips] = about_vertical(heading) * pose[roles.hips];
  clip.translation(frame)[roles.hips] = hips;
}

}  // namespace gait
