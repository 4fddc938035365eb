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
  double x, y, z;  // usual offset, metres; x for the left side
};

constexpr int fingers_begin = index_of(Bone::left_fingers);

// Lengths of a usual body: shares of its height after Winter 2009, table 4.1, at 1.70 m.
constexpr std::array<Named, main_bones + 3> bones{{
    {"Hips", -1, 0, 0.93, 0},
    {"Spine", 0, 0, 0.10, 0},
    {"Chest", 1, 0, 0.13, 0},
    {"UpperChest", 2, 0, 0.12, 0},
    {"Neck", 3, 0, 0.14, 0},
    {"Head", 4, 0, 0.09, 0},
    {"LeftShoulder", 3, 0.03, 0.10, 0},
    {"LeftUpperArm", 6, 0.14, 0, 0},
    {"LeftLowerArm", 7, 0.30, 0, 0},
    {"LeftHand", 8, 0.25, 0, 0},
    {"RightShoulder", 3, -0.03, 0.10, 0},
    {"RightUpperArm", 10, -0.14, 0, 0},
    {"RightLowerArm", 11, -0.30, 0, 0},
    {"RightHand", 12, -0.25, 0, 0},
    {"LeftUpperLeg", 0, 0.09, -0.02, 0},
    {"LeftLowerLeg", 14, 0, -0.42, 0},
    {"LeftFoot", 15, 0, -0.42, 0},
    {"LeftToes", 16, 0, -0.05, 0.13},
    {"RightUpperLeg", 0, -0.09, -0.02, 0},
    {"RightLowerLeg", 18, 0, -0.42, 0},
    {"RightFoot", 19, 0, -0.42, 0},
    {"RightToes", 20, 0, -0.05, 0.13},
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

int bone_of(Role role) {
  switch (role) {
    case Role::hips:
      return index_of(Bone::hips);
    case Role::spine:
      return index_of(Bone::spine);
    case Role::neck:
      return index_of(Bone::neck);
    case Role::head:
      return index_of(Bone::head);
    case Role::left_shoulder:
      return index_of(Bone::left_shoulder);
    case Role::left_arm:
      return index_of(Bone::left_upper_arm);
    case Role::left_forearm:
      return index_of(Bone::left_lower_arm);
    case Role::left_hand:
      return index_of(Bone::left_hand);
    case Role::right_shoulder:
      return index_of(Bone::right_shoulder);
    case Role::right_arm:
      return index_of(Bone::right_upper_arm);
    case Role::right_forearm:
      return index_of(Bone::right_lower_arm);
    case Role::right_hand:
      return index_of(Bone::right_hand);
    case Role::left_thigh:
      return index_of(Bone::left_upper_leg);
    case Role::left_shank:
      return index_of(Bone::left_lower_leg);
    case Role::left_foot:
      return index_of(Bone::left_foot);
    case Role::left_toes:
      return index_of(Bone::left_toes);
    case Role::right_thigh:
      return index_of(Bone::right_upper_leg);
    case Role::right_shank:
      return index_of(Bone::right_lower_leg);
    case Role::right_foot:
      return index_of(Bone::right_foot);
    case Role::right_toes:
      return index_of(Bone::right_toes);
    case Role::none:
      break;
  }
  return -1;
}

int bone_named(std::string_view name) {
  for (int bone = 0; bone < humanoid_bones; ++bone)
    if (same_letters(name, bone_name(bone))) return bone;
  Skeleton alone;
  alone.joints.emplace_back().name = name;
  return bone_of(find_roles(alone).of_joint[0]);
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
