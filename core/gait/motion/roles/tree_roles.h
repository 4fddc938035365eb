// Roles from the tree, where names leave them open. Private to finding roles.
#pragma once

#include <vector>

#include "gait/motion/joint_roles.h"
#include "gait/motion/roles/joint_words.h"

namespace gait {

// Fills roles that no joint has from the lengths and places of chains: legs, arms, spine, neck and
// head. Joints whose role is settled (`said`) are left alone; `sides`: one per joint, what names
// say.
void add_roles_from_tree(const Clip& clip, JointRoles& roles, const std::vector<bool>& said,
                         const std::vector<Side>& sides);

}  // namespace gait
