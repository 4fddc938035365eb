// Humanoid: the set of bones by which programs exchange live motion, independent of the names in
// their rigs. Names and tree are those of Unity's HumanBodyBones, which the VMC protocol uses.
//
// A pose is a set of turns: per bone its rotation in the world since the T-pose, in which the body
// stands upright, faces +Z and stretches its arms along +X (left) and -X (right). Turns do not
// depend on the rest rotations of a rig's joints, so every rig can be read and driven by them.
// Metres, Y up, right-handed.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <bitset>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gait/motion/joint_roles.h"
#include "gait/motion/skeleton.h"

namespace gait {

enum class Bone {  // parents before children
  hips,
  spine,
  chest,
  upper_chest,
  neck,
  head,
  left_shoulder,
  left_upper_arm,
  left_lower_arm,
  left_hand,
  right_shoulder,
  right_upper_arm,
  right_lower_arm,
  right_hand,
  left_upper_leg,
  left_lower_leg,
  left_foot,
  left_toes,
  right_upper_leg,
  right_lower_leg,
  right_foot,
  right_toes,
  // Bones without a role in walking; recordings keep them.
  jaw,
  left_eye,
  right_eye,
  left_fingers,  // fifteen: thumb, index, middle, ring, little; proximal, intermediate, distal
  right_fingers = left_fingers + 15,
};

inline constexpr int humanoid_bones = static_cast<int>(Bone::right_fingers) + 15;
inline constexpr int main_bones = static_cast<int>(Bone::jaw);  // those with a role

constexpr int index_of(Bone bone) { return static_cast<int>(bone); }

std::string_view bone_name(int bone);  // "LeftUpperArm"
int bone_parent(int bone);             // -1 for the hips
// Finds a bone by Unity's name, in upper or lower case, or by a joint's name in another known rig;
// -1: the name is not known.
int bone_named(std::string_view name);
// The same for all names that a sender uses: together they tell what one alone leaves open
// ('LShoulder' is the collar bone beside 'LUArm').
std::vector<int> bones_named(std::span<const std::string> names);

// The bone that a joint of a skeleton follows. Where a spine or neck has several joints, each takes
// its share of the turn.
struct JointBone {
  int bone = -1;     // -1: follows its parent
  double share = 1;  // of the turn from the bone before; for the spine: of the whole spine
};
std::vector<JointBone> bones_of_joints(const Skeleton& skeleton, std::span<const Role> roles);

struct HumanoidPose {
  std::bitset<humanoid_bones> turned, placed;  // bones whose turn or place is known
  std::array<Eigen::Quaterniond, humanoid_bones> turns;
  std::array<Eigen::Vector3d, humanoid_bones> places;  // in the world, metres

  HumanoidPose() { clear(); }
  void clear() noexcept {
    turned.reset();
    placed.reset();
    turns.fill(Eigen::Quaterniond::Identity());
    places.fill(Eigen::Vector3d::Zero());
  }
  // The nearest bone above whose turn is known, -1 when there is none.
  int turned_above(int bone) const noexcept {
    do bone = bone_parent(bone);
    while (bone >= 0 && !turned[static_cast<std::size_t>(bone)]);
    return bone;
  }
  // Turn relative to that bone; in the world when there is none.
  Eigen::Quaterniond local_turn(int bone) const noexcept {
    const int above = turned_above(bone);
    return above < 0 ? turns[bone] : turns[above].conjugate() * turns[bone];
  }
  bool locally_placed(int bone) const noexcept {
    const int above = turned_above(bone);
    return placed[bone] && (above < 0 || placed[above]);
  }
  Eigen::Vector3d local_place(int bone) const noexcept {
    const int above = turned_above(bone);
    return above < 0 ? places[bone] : turns[above].conjugate() * (places[bone] - places[above]);
  }
};

// Converts between our frame and one with X mirrored: Unity's is left-handed with X to the right.
inline Eigen::Quaterniond mirrored(const Eigen::Quaterniond& q) noexcept {
  return {q.w(), q.x(), -q.y(), -q.z()};
}
inline Eigen::Vector3d mirrored(const Eigen::Vector3d& v) noexcept {
  return {-v.x(), v.y(), v.z()};
}

// Offset of a bone from its parent, for a person of 1.7 m in the T-pose, metres: stands in where a
// sender has no positions.
Eigen::Vector3d usual_offset(int bone);

}  // namespace gait
