#include "gait/motion/roles/joint_names.h"

#include <algorithm>
#include <array>

namespace gait {
namespace {

struct PartRoles {
  Part part;
  Role right, left;
};

constexpr std::array<PartRoles, 12> part_roles{{
    {Part::hips, Role::hips, Role::hips},
    {Part::spine, Role::spine, Role::spine},
    {Part::neck, Role::neck, Role::neck},
    {Part::head, Role::head, Role::head},
    {Part::shoulder, Role::right_shoulder, Role::left_shoulder},
    {Part::arm, Role::right_arm, Role::left_arm},
    {Part::forearm, Role::right_forearm, Role::left_forearm},
    {Part::hand, Role::right_hand, Role::left_hand},
    {Part::thigh, Role::right_thigh, Role::left_thigh},
    {Part::shank, Role::right_shank, Role::left_shank},
    {Part::foot, Role::right_foot, Role::left_foot},
    {Part::toes, Role::right_toes, Role::left_toes},
}};

Role role_of(Side side, Part part) {
  const auto roles = std::ranges::find(part_roles, part, &PartRoles::part);
  if (roles == part_roles.end()) return Role::none;
  return side == Side::left ? roles->left : roles->right;
}

// The rig's names together.
class NameSet {
 public:
  explicit NameSet(const Skeleton& skeleton) : skeleton_(skeleton) {
    std::vector<std::string_view> names;
    for (const Joint& joint : skeleton.joints)
      names.push_back(joint.sits_at.empty() ? joint.name : joint.sits_at);
    meanings_ = meanings_of(names);
  }

  const NameMeaning& meaning(int joint) const { return meanings_[joint]; }

  // Decides the names that mean different things in different rigs.
  Part settled(int joint) const {
    const NameMeaning& name = meanings_[joint];
    // Either side shows which words the rig uses.
    const auto rig_has = [&](Part part) { return has(Side::left, part) || has(Side::right, part); };
    switch (name.part) {
      case Part::centre:
        return Part::hips;
      case Part::hip_or_thigh:
        return rig_has(Part::thigh) || above_another_hip(joint) ? Part::unknown : Part::thigh;
      case Part::leg:
        if (rig_has(Part::thigh) || any_above(joint, Part::hip_or_thigh)) return Part::shank;
        return rig_has(Part::shank) ? Part::thigh : Part::shank;
      case Part::shoulder_or_arm:
        return rig_has(Part::arm) ? Part::shoulder : Part::arm;
      case Part::foot_or_toes:
        return any_above(joint, Part::foot) && !rig_has(Part::toes) ? Part::toes : Part::foot;
      default:
        return name.part;
    }
  }

 private:
  // A twist joint is a helper, unless nothing else of the rig is that part.
  bool has(Side side, Part part) const {
    return std::ranges::any_of(meanings_, [&](const NameMeaning& other) {
      return other.side == side && other.part == part && !other.twist;
    });
  }

  // "LHipJoint" is only the mount of "LeftHip".
  bool above_another_hip(int joint) const {
    const NameMeaning& mine = meanings_[joint];
    for (int other = joint + 1; other < skeleton_.size(); ++other)
      if (meanings_[other].part == mine.part && meanings_[other].side == mine.side &&
          !meanings_[other].twist && skeleton_.is_in_branch(other, joint))
        return true;
    return false;
  }

  // Names without a tree (all joints roots) lie anywhere.
  bool any_above(int joint, Part part) const {
    const Side side = meanings_[joint].side;
    const bool no_tree =
        std::ranges::all_of(skeleton_.joints, [](const Joint& one) { return one.parent < 0; });
    if (no_tree) return has(side, part);
    for (int above = skeleton_.joints[joint].parent; above >= 0;
         above = skeleton_.joints[above].parent)
      if (meanings_[above].side == side && meanings_[above].part == part) return true;
    return false;
  }

  const Skeleton& skeleton_;
  std::vector<NameMeaning> meanings_;
};

}  // namespace

std::vector<NamedRole> roles_from_names(const Skeleton& skeleton) {
  const NameSet names(skeleton);
  std::vector<NamedRole> roles;
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    const NameMeaning& name = names.meaning(joint);
    roles.push_back(
        {role_of(name.side, names.settled(joint)), name.side, name.part == Part::centre});
  }
  for (int joint = 0; joint < skeleton.size(); ++joint)
    if (names.meaning(joint).twist)
      for (int other = 0; other < skeleton.size(); ++other)
        if (roles[other].role == roles[joint].role && !names.meaning(other).twist)
          roles[joint].role = Role::none;
  return roles;
}

}  // namespace gait
