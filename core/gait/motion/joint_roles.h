// Joint roles: which joint is the hips, the left shank, the head. They are found from the names of
// a rig together, then from its tree; a table of the user's overrides both.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gait/motion/clip.h"
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

// What a role was understood from.
enum class RoleSource { none, name, tree, table };

struct JointRoles {
  // One per joint. Several may share a role: spine, neck, hand, a thigh in two pieces.
  std::vector<Role> of_joint;
  std::vector<RoleSource> from{};  // one per joint; may be empty
  // One per joint: true from the thighs down to the last toe, and for unnamed joints between hips
  // and thigh. All of them move with the leg, so none may count as input when legs are output. So
  // does a joint that was turned over onto the hips.
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

// Finds roles from all names of the rig together: what all share, sides, and names that mean
// different bones in different rigs ('LeftShoulder' is the collar bone beside 'LeftArm'). What
// names leave open is found from the tree: two long chains that lead away from the rest of the body
// are legs, two from the upper trunk are arms; their sides follow from where feet and knees point
// in the clip's frames, or at rest when it has none. Without a joint named as hips, the hips are
// the joint from which both thighs descend. A role that the table gives to a joint is not given to
// others.
JointRoles find_roles(const Clip& clip, const RoleTable& table = {});
JointRoles find_roles(const Skeleton& skeleton, const RoleTable& table = {});

// Roles of names alone, as a sender tells them: no tree is known.
std::vector<Role> roles_of_names(std::span<const std::string> names);

// The roles that must be known to follow a walk and that no joint has, in words: "hips, left
// shank". Empty when there are none.
std::string missing_roles(const JointRoles& roles);
// A table with one line per joint, in the skeleton's order: what read_role_table reads.
std::string role_table_text(const Skeleton& skeleton, const JointRoles& roles);

// Names of the table that no joint of the skeleton has: misspelt, or meant for another rig.
std::vector<std::string> names_not_in(const Skeleton& skeleton, const RoleTable& table);

// Reads a table: one `joint = role` a line, # starts a comment. Throws Error with file and line.
RoleTable read_role_table(const std::filesystem::path& path);
RoleTable parse_role_table(std::string_view text, const std::string& name);

}  // namespace gait
