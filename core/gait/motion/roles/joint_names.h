// Joint names: roles from the names that rigs use. Private to finding roles.
#pragma once

#include <vector>

#include "gait/motion/joint_roles.h"
#include "gait/motion/roles/joint_words.h"

namespace gait {

struct NamedRole {
  Role role = Role::none;
  Side side = Side::none;  // also of joints whose part is not known
  bool vague = false;      // the centre of a body: its hips, unless others are
};

// One per joint, from names alone and from which other names the rig uses: 'LeftShoulder' is the
// collar bone beside 'LeftArm', and the upper arm beside 'LeftElbow'.
std::vector<NamedRole> roles_from_names(const Skeleton& skeleton);

}  // namespace gait
