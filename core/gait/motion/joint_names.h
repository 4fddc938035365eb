// Joint names: roles from the names that rigs use. Private to finding roles.
#pragma once

#include <vector>

#include "gait/motion/joint_roles.h"

namespace gait {

// One role per joint, from names alone and from which other names the rig uses: 'LeftShoulder' is
// the collar bone beside 'LeftArm', and the upper arm beside 'LeftElbow'.
std::vector<Role> roles_from_names(const Skeleton& skeleton);

}  // namespace gait
