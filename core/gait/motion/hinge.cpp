#include "gait/motion/hinge.h"

namespace gait {

std::vector<Hinge> find_hinges(const Skeleton& skeleton, const JointRoles& roles) {
  std::vector<Hinge> hinges;
  const auto is_below = [&](int joint, int above) {
    return joint != above && skeleton.is_in_branch(joint, above);
  };
  const auto add = [&](int above, int joint, int below) {
    if (!is_below(joint, above)) return;
    if (below < 0 ? skeleton.joints[joint].tips.empty() : !is_below(below, joint)) return;
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
