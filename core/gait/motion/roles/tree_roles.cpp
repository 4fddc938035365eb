#include "gait/motion/roles/tree_roles.h"

#include <algorithm>
#include <array>

#include "gait/motion/roles/limb_chains.h"

namespace gait {
namespace {

using SideRoles = std::array<Role, 4>;
constexpr SideRoles left_leg{Role::left_thigh, Role::left_shank, Role::left_foot, Role::left_toes};
constexpr SideRoles right_leg{Role::right_thigh, Role::right_shank, Role::right_foot,
                              Role::right_toes};
constexpr SideRoles left_arm{Role::left_shoulder, Role::left_arm, Role::left_forearm,
                             Role::left_hand};
constexpr SideRoles right_arm{Role::right_shoulder, Role::right_arm, Role::right_forearm,
                              Role::right_hand};

class TreeRoles {
 public:
  TreeRoles(const Clip& clip, JointRoles& roles, const std::vector<bool>& said,
            const std::vector<Side>& sides)
      : rig_(clip), skeleton_(clip.skeleton), roles_(roles), said_(said), sides_(sides) {}

  void add() {
    const auto legs = find_leg_chains(rig_);
    if (!legs) return;
    const std::array<LimbJoints, 2> joints = joints_of_legs(rig_, *legs);
    double left = side_by_names(*legs);
    if (left == 0) left = first_is_left(rig_, joints);
    give(joints[0], left > 0 ? left_leg : right_leg);
    give(joints[1], left > 0 ? right_leg : left_leg);
    std::vector<bool> taken(skeleton_.joints.size(), false);
    for (int joint = 0; joint < skeleton_.size(); ++joint)
      taken[joint] = skeleton_.is_in_branch(joint, legs->chains[0].front()) ||
                     skeleton_.is_in_branch(joint, legs->chains[1].front());
    const auto arms = find_arm_chains(rig_, taken);
    if (!arms) return;
    add_arms(*arms, joints, left);
    add_trunk(*arms, legs->parent);
  }

 private:
  bool has(Role role) const { return roles_.joint(role) >= 0; }

  void give(int joint, Role role) {
    if (joint < 0 || said_[joint] || has(role) || roles_.of_joint[joint] != Role::none) return;
    roles_.of_joint[joint] = role;
    roles_.from[joint] = RoleSource::tree;
  }
  void give(const LimbJoints& joints, const SideRoles& roles) {
    for (std::size_t i = 0; i < joints.size(); ++i) give(joints[i], roles[i]);
  }

  // Above zero: the first is the left one, by the sides in names.
  double side_by_names(const LimbPair& pair) const {
    double left = 0;
    for (int joint = 0; joint < skeleton_.size(); ++joint) {
      const double says = sides_[joint] == Side::left ? 1 : sides_[joint] == Side::right ? -1 : 0;
      if (skeleton_.is_in_branch(joint, pair.chains[0].front())) left += says;
      if (skeleton_.is_in_branch(joint, pair.chains[1].front())) left -= says;
    }
    return left;
  }

  // Arms are on the sides of the legs, in the poses seen.
  void add_arms(const LimbPair& arms, const std::array<LimbJoints, 2>& legs, double first_leg) {
    const std::array<LimbJoints, 2> joints{joints_of_arm(rig_, arms.chains[0]),
                                           joints_of_arm(rig_, arms.chains[1])};
    double left = side_by_names(arms);
    if (left == 0)
      for (int pose = 0; pose < rig_.poses(); ++pose)
        left += (first_leg > 0 ? 1 : -1) *
                (rig_.place(pose, legs[0][0]) - rig_.place(pose, legs[1][0]))
                    .dot(rig_.place(pose, joints[0][1]) - rig_.place(pose, joints[1][1]));
    give(joints[0], left > 0 ? left_arm : right_arm);
    give(joints[1], left > 0 ? right_arm : left_arm);
  }

  // From the hips to where the arms begin is spine; what goes on from there is neck and head.
  void add_trunk(const LimbPair& arms, int hips) {
    std::vector<int> trunk;
    for (int joint = arms.parent; joint >= 0 && joint != hips;
         joint = skeleton_.joints[joint].parent)
      trunk.insert(trunk.begin(), joint);
    const bool spine_known = has(Role::spine), head_known = has(Role::head);
    for (const int joint : trunk)
      if (!spine_known && !said_[joint] && roles_.of_joint[joint] == Role::none &&
          skeleton_.is_in_branch(joint, hips)) {
        roles_.of_joint[joint] = Role::spine;
        roles_.from[joint] = RoleSource::tree;
      }
    int up = -1;
    for (const int child : rig_.children(arms.parent))
      if (child != arms.chains[0].front() && child != arms.chains[1].front() &&
          (up < 0 || rig_.reach(child) > rig_.reach(up)))
        up = child;
    if (up < 0 || head_known) return;
    std::vector<int> chain{up};
    while (rig_.children(chain.back()).size() == 1)
      chain.push_back(rig_.children(chain.back()).front());
    give(chain.back(), Role::head);
    if (chain.size() > 1 && !has(Role::neck)) give(chain.front(), Role::neck);
  }

  RigPoses rig_;
  const Skeleton& skeleton_;
  JointRoles& roles_;
  const std::vector<bool>& said_;
  const std::vector<Side>& sides_;
};

}  // namespace

void add_roles_from_tree(const Clip& clip, JointRoles& roles, const std::vector<bool>& said,
                         const std::vector<Side>& sides) {
  TreeRoles(clip, roles, said, sides).add();
}

}  // namespace gait
