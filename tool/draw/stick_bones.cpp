#include "draw/stick_bones.h"

#include <algorithm>

namespace gait::tool {

namespace {

// The side of the bones that start at a joint with this role. The pelvis and the collar bones stay
// neutral: they belong to the trunk.
Side side_of(Role role) {
  switch (role) {
    case Role::left_arm:
    case Role::left_forearm:
    case Role::left_hand:
    case Role::left_thigh:
    case Role::left_shank:
    case Role::left_foot:
    case Role::left_toes:
      return Side::left;
    case Role::right_arm:
    case Role::right_forearm:
    case Role::right_hand:
    case Role::right_thigh:
    case Role::right_shank:
    case Role::right_foot:
    case Role::right_toes:
      return Side::right;
    default:
      return Side::middle;
  }
}

bool is_end(Role role) {
  return role == Role::head || role == Role::left_hand || role == Role::right_hand;
}

// What hangs on an arm or a leg and has no role (twist joints, fingers) belongs to its side.
std::vector<Side> sides(const Skeleton& skeleton, const JointRoles& roles) {
  std::vector<Side> side(skeleton.size(), Side::middle);
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    side[joint] = side_of(roles.of_joint[joint]);
    const int parent = skeleton.joints[joint].parent;
    if (side[joint] == Side::middle && parent >= 0) side[joint] = side[parent];
  }
  return side;
}

// Fingers and faces: whatever comes after a hand's or the head's own joint.
std::vector<bool> beyond_ends(const Skeleton& skeleton, const JointRoles& roles) {
  std::vector<bool> beyond(skeleton.size(), false);
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    const int parent = skeleton.joints[joint].parent;
    if (parent < 0) continue;
    const bool same_role = roles.of_joint[joint] == roles.of_joint[parent];
    beyond[joint] = beyond[parent] || (is_end(roles.of_joint[parent]) && !same_role);
  }
  return beyond;
}

// Rigs put empty roots between the floor and the hips: no bone leads from them.
std::vector<bool> above_hips(const Skeleton& skeleton, const JointRoles& roles) {
  std::vector<bool> above(skeleton.size(), false);
  if (roles.hips < 0) return above;
  for (int joint = skeleton.joints[roles.hips].parent; joint >= 0;
       joint = skeleton.joints[joint].parent)
    above[joint] = true;
  return above;
}

// A disc for the head, unless the rig draws the face itself.
void add_head(StickBones& figure, const Skeleton& skeleton, const JointRoles& roles, double body) {
  const int head = roles.joint(Role::head);
  if (head < 0 || skeleton.joints[head].parent < 0) return;
  int children = 0;
  Eigen::Vector3d top = Eigen::Vector3d::Zero();
  for (const Joint& joint : skeleton.joints)
    if (joint.parent == head) {
      ++children;
      if (joint.offset.norm() > top.norm()) top = joint.offset;
    }
  if (children > 3) return;
  for (const Eigen::Vector3d& tip : skeleton.joints[head].tips)
    if (tip.norm() > top.norm()) top = tip;

  // A head is an eighth of a person; files differ in what their tip means.
  const Eigen::Vector3d up = top.norm() > 1e-9 ? top : skeleton.joints[head].offset;
  if (up.norm() < 1e-9 || body < 1e-9) return;
  figure.head_radius = std::clamp(top.norm() / 2, 0.055 * body, 0.07 * body);
  figure.head_centre = static_cast<int>(figure.points.size());
  figure.points.push_back({head, up.normalized() * figure.head_radius});
  figure.drawn.push_back(true);
}

}  // namespace

StickBones stick_bones(const Skeleton& skeleton, const JointRoles& roles, double body) {
  const std::vector<Side> side = sides(skeleton, roles);
  const std::vector<bool> beyond = beyond_ends(skeleton, roles);
  const std::vector<bool> above = above_hips(skeleton, roles);

  StickBones figure;
  for (int joint = 0; joint < skeleton.size(); ++joint) figure.points.push_back({joint, {0, 0, 0}});
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    const int parent = skeleton.joints[joint].parent;
    if (parent >= 0 && !above[parent])
      figure.bones.push_back({parent, joint, side[parent], beyond[joint]});
  }
  const int head = roles.joint(Role::head);
  for (int joint = 0; joint < skeleton.size(); ++joint)
    for (const Eigen::Vector3d& tip : skeleton.joints[joint].tips) {
      if (above[joint] || tip.norm() < 1e-9) continue;
      figure.points.push_back({joint, tip});
      if (joint != head)
        figure.bones.push_back(
            {joint, static_cast<int>(figure.points.size()) - 1, side[joint], beyond[joint]});
    }

  figure.drawn.assign(figure.points.size(), false);
  for (const Bone& bone : figure.bones) figure.drawn[bone.from] = figure.drawn[bone.to] = true;
  add_head(figure, skeleton, roles, body);
  if (figure.head_centre < 0 && head >= 0)
    for (std::size_t point = skeleton.size(); point < figure.points.size(); ++point)
      if (figure.points[point].joint == head) {
        figure.bones.push_back({head, static_cast<int>(point), Side::middle, beyond[head]});
        figure.drawn[head] = figure.drawn[point] = true;
      }
  // A skeleton of one joint is still a dot.
  if (figure.bones.empty() && !figure.drawn.empty()) figure.drawn[0] = true;
  return figure;
}

}  // namespace gait::tool
