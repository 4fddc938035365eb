#include "gait/motion/hinge.h"

namespace gait {

namespace {

bool is_below(const Skeleton& skeleton, int joint, int ancestor) {
  if (joint < 0 || ancestor < 0) return false;
  for (int at = skeleton.joints[joint].parent; at >= 0; at = skeleton.joints[at].parent)
    if (at == ancestor) return true;
  return false;
}

}  // namespace

std::vector<Hinge> find_hinges(const Skeleton& skeleton, const JointRoles& roles) {
  std::vector<Hinge> hinges;
  const auto add = [&](int above, int joint, int below) {
    if (!is_below(skeleton, joint, above)) return;
    if (below < 0 ? skeleton.joints[joint].tips.empty() : !is_below(skeleton, below, joint)) return;
    Hinge hinge;
    hinge.above = above, hinge.joint = joint, hinge.below = below;
    hinges.push_back(hinge);
  };
  for (const Leg& leg : {roles.right, roles.left}) add(leg.thigh, leg.shank, leg.foot);
  add(roles.joint(Role::right_arm), roles.joint(Role::right_forearm),
      roles.joint(Role::right_hand));
  add(roles.joint(Role::left_arm), roles.joint(Role::left_forearm), roles.joint(Role::left_hand));
  return hinges;
}

}  // namespace gait
