#include "gait/motion/humanoid.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <string>

namespace gait {

namespace {

struct Named {
  std::string_view name;
  int parent;
  double x, y, z;  // usual offset, metres
  Role role = Role::none;
};

constexpr int fingers_begin = index_of(Bone::left_fingers);

// Lengths of a usual body: shares of its height after Winter 2009, table 4.1, at 1.70 m.
constexpr std::array<Named, main_bones + 3> bones{{
    {"Hips", -1, 0, 0.93, 0, Role::hips},
    {"Spine", 0, 0, 0.10, 0, Role::spine},
    {"Chest", 1, 0, 0.13, 0},
    {"UpperChest", 2, 0, 0.12, 0},
    {"Neck", 3, 0, 0.14, 0, Role::neck},
    {"Head", 4, 0, 0.09, 0, Role::head},
    {"LeftShoulder", 3, 0.03, 0.10, 0, Role::left_shoulder},
    {"LeftUpperArm", 6, 0.14, 0, 0, Role::left_arm},
    {"LeftLowerArm", 7, 0.30, 0, 0, Role::left_forearm},
    {"LeftHand", 8, 0.25, 0, 0, Role::left_hand},
    {"RightShoulder", 3, -0.03, 0.10, 0, Role::right_shoulder},
    {"RightUpperArm", 10, -0.14, 0, 0, Role::right_arm},
    {"RightLowerArm", 11, -0.30, 0, 0, Role::right_forearm},
    {"RightHand", 12, -0.25, 0, 0, Role::right_hand},
    {"LeftUpperLeg", 0, 0.09, -0.02, 0, Role::left_thigh},
    {"LeftLowerLeg", 14, 0, -0.42, 0, Role::left_shank},
    {"LeftFoot", 15, 0, -0.42, 0, Role::left_foot},
    {"LeftToes", 16, 0, -0.05, 0.13, Role::left_toes},
    {"RightUpperLeg", 0, -0.09, -0.02, 0, Role::right_thigh},
    {"RightLowerLeg", 18, 0, -0.42, 0, Role::right_shank},
    {"RightFoot", 19, 0, -0.42, 0, Role::right_foot},
    {"RightToes", 20, 0, -0.05, 0.13, Role::right_toes},
    {"Jaw", 5, 0, 0.02, 0.05},
    {"LeftEye", 5, 0.03, 0.06, 0.08},
    {"RightEye", 5, -0.03, 0.06, 0.08},
}};

constexpr std::array<std::string_view, 30> fingers{
    "LeftThumbProximal",   "LeftThumbIntermediate",   "LeftThumbDistal",
    "LeftIndexProximal",   "LeftIndexIntermediate",   "LeftIndexDistal",
    "LeftMiddleProximal",  "LeftMiddleIntermediate",  "LeftMiddleDistal",
    "LeftRingProximal",    "LeftRingIntermediate",    "LeftRingDistal",
    "LeftLittleProximal",  "LeftLittleIntermediate",  "LeftLittleDistal",
    "RightThumbProximal",  "RightThumbIntermediate",  "RightThumbDistal",
    "RightIndexProximal",  "RightIndexIntermediate",  "RightIndexDistal",
    "RightMiddleProximal", "RightMiddleIntermediate", "RightMiddleDistal",
    "RightRingProximal",   "RightRingIntermediate",   "RightRingDistal",
    "RightLittleProximal", "RightLittleIntermediate", "RightLittleDistal",
};

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) ==
           std::tolower(static_cast<unsigned char>(y));
  });
}

// -1 for Role::none; the spine's first bone for Role::spine.
int bone_of(Role role) {
  const auto bone = std::ranges::find(bones, role, &Named::role);
  return role == Role::none || bone == bones.end() ? -1 : static_cast<int>(bone - bones.begin());
}

}  // namespace

std::string_view bone_name(int bone) {
  return bone < fingers_begin ? bones[static_cast<std::size_t>(bone)].name
                              : fingers[static_cast<std::size_t>(bone - fingers_begin)];
}

int bone_parent(int bone) {
  if (bone < fingers_begin) return bones[static_cast<std::size_t>(bone)].parent;
  const int finger = bone - fingers_begin;
  if (finger % 3 != 0) return bone - 1;
  return index_of(finger < 15 ? Bone::left_hand : Bone::right_hand);
}

int bone_named(std::string_view name) {
  for (int bone = 0; bone < humanoid_bones; ++bone)
    if (same_letters(name, bone_name(bone))) return bone;
  const std::string alone(name);
  return bone_of(roles_of_names({&alone, 1})[0]);
}

std::vector<int> bones_named(std::span<const std::string> names) {
  std::vector<int> found;
  for (const Role role : roles_of_names(names)) found.push_back(bone_of(role));
  for (std::size_t i = 0; i < names.size(); ++i)
    for (int bone = 0; bone < humanoid_bones; ++bone) {
      // What its role leaves out: chest, fingers, eyes. The spine's role has three bones.
      const bool open = found[i] < 0 || found[i] == index_of(Bone::spine);
      if (open && same_letters(names[i], bone_name(bone))) found[i] = bone;
    }
  return found;
}

std::vector<JointBone> bones_of_joints(const Skeleton& skeleton, std::span<const Role> roles) {
  std::map<Role, int> count, before;
  for (const Role role : roles) ++count[role];
  std::vector<JointBone> joints(skeleton.joints.size());
  for (std::size_t joint = 0; joint < joints.size(); ++joint) {
    const Role role = roles[joint];
    joints[joint].bone = bone_of(role);
    if (joints[joint].bone < 0) continue;
    ++before[role];
    if (role == Role::spine || role == Role::neck)
      joints[joint].share = static_cast<double>(before[role]) / count[role];
    else if (before[role] > 1)
      joints[joint].bone = -1;  // a limb's second piece
  }
  return joints;
}

Eigen::Vector3d usual_offset(int bone) {
  if (bone < fingers_begin) {
    const Named& named = bones[static_cast<std::size_t>(bone)];
    return {named.x, named.y, named.z};
  }
  const int finger = bone - fingers_begin;
  const double side = finger < 15 ? 1 : -1;
  const int which = finger % 15 / 3;  // from the thumb
  if (finger % 3 != 0) return {side * 0.03, 0, 0};
  return {side * (which == 0 ? 0.03 : 0.09), 0, which == 0 ? 0.03 : 0.045 - 0.02 * which};
}

}  // namespace gait
