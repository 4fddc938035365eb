// Joint roles: which joint is the hips, the left shank, the head. They are found from usual names;
// a table of the user's overrides them.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gait/motion/skeleton.h"

namespace gait {

enum class Role {
  none,
  hips,
  spine,
  neck,
  head,
  left_shoulder,
  left_arm,
  left_forearm,
  left_hand,
  right_shoulder,
  right_arm,
  right_forearm,
  right_hand,
  left_thigh,
  left_shank,
  left_foot,
  left_toes,
  right_thigh,
  right_shank,
  right_foot,
  right_toes,
};

std::string_view role_name(Role role);                      // "left thigh"
std::optional<Role> role_from_name(std::string_view name);  // also "left_thigh", "LeftThigh"

// The joints of one leg; toes may be missing (-1).
struct Leg {
  int thigh = -1, shank = -1, foot = -1, toes = -1;
};

struct JointRoles {
  // One per joint. Several may share a role: spine, neck, hand, a thigh in two pieces.
  std::vector<Role> of_joint;
  // One per joint: true from the thighs down to the last toe, and for unnamed joints between hips
  // and thigh. All of them move with the leg, so none may count as input when legs are output.
  std::vector<bool> in_leg;
  int hips = -1;
  Leg left, right;

  // First joint with this role, -1 when there is none.
  int joint(Role role) const;
  bool has_legs() const {
    return hips >= 0 && left.thigh >= 0 && left.shank >= 0 && left.foot >= 0 && right.thigh >= 0 &&
           right.shank >= 0 && right.foot >= 0;
  }
  // The hips and all joints in a leg, in the skeleton's order: the joints synthesised by default.
  std::vector<int> hips_and_legs() const;
};

// From hip to ankle along the bones of the left leg, whatever joints a rig has in between: the
// length that speeds and strides are measured in. In the skeleton's unit; 0 without that leg.
double leg_length(const Skeleton& skeleton, const JointRoles& roles);

// A table that overrides what names suggest: joint name -> role.
using RoleTable = std::map<std::string, Role>;

// Finds roles from names (Bandai-Namco, CMU, Mixamo, Xsens, Perception Neuron, VRM/Unity and
// others). Without a joint named as hips, the hips are the joint from which both thighs descend. A
// role that the table gives to a joint is not given to others by their names.
JointRoles find_roles(const Skeleton& skeleton, const RoleTable& table = {});

// Names of the table that no joint of the skeleton has: misspelt, or meant for another rig.
std::vector<std::string> names_not_in(const Skeleton& skeleton, const RoleTable& table);

// Reads a table: one `joint = role` a line, # starts a comment. Throws Error with file and line.
RoleTable read_role_table(const std::filesystem::path& path);
RoleTable parse_role_table(std::string_view text, const std::string& name);

}  // namespace gait
