#include "gait/osc/mocopi_joints.h"

#include <array>

#include "gait/motion/humanoid.h"

namespace gait::osc {

namespace {

struct MocopiJoint {
  int parent;
  double x, y, z;
  Bone bone = Bone::jaw;  // none
};

// Joints of the right side are those of the left, mirrored.
constexpr int left_arm = 11, right_arm = 15, left_leg = 19, right_leg = 23;
constexpr std::array<MocopiJoint, mocopi_joints> table{{
    {-1, 0, 0.93293, 0, Bone::hips},
    {0, 0, 0.05079, -0.01151, Bone::spine},
    {1, 0, 0.05617, 0.01071},
    {2, 0, 0.05990, 0.00115, Bone::chest},
    {3, 0, 0.06506, -0.00444},
    {4, 0, 0.07605, -0.01506, Bone::upper_chest},
    {5, 0, 0.09497, -0.00914},
    {6, 0, 0.10551, 0.01577},
    {7, 0, 0.04786, 0.00715, Bone::neck},
    {8, 0, 0.04821, 0.00422},
    {9, 0, 0.04830, 0.00765, Bone::head},
    {7, 0.01233, -0.07607, 0.07534, Bone::left_shoulder},
    {11, 0.12955, 0.03249, -0.03269, Bone::left_upper_arm},
    {12, 0.29208, 0.0006, 0.00137, Bone::left_lower_arm},
    {13, 0.24234, 0.0005, 0.00114, Bone::left_hand},
    {7, 0, 0, 0, Bone::right_shoulder},
    {15, 0, 0, 0, Bone::right_upper_arm},
    {16, 0, 0, 0, Bone::right_lower_arm},
    {17, 0, 0, 0, Bone::right_hand},
    {0, 0.09237, -0.04206, 0.02033, Bone::left_upper_leg},
    {19, -0.00852, -0.38772, -0.00655, Bone::left_lower_leg},
    {20, -0.02326, -0.40402, -0.06049, Bone::left_foot},
    {21, 0.00779, -0.09884, 0.12496, Bone::left_toes},
    {0, 0, 0, 0, Bone::right_upper_leg},
    {23, 0, 0, 0, Bone::right_lower_leg},
    {24, 0, 0, 0, Bone::right_foot},
    {25, 0, 0, 0, Bone::right_toes},
}};

}  // namespace

int mocopi_parent(int joint) { return table[static_cast<std::size_t>(joint)].parent; }

Eigen::Vector3d mocopi_offset(int joint) {
  int from = joint;
  if (joint >= right_leg)
    from = joint - right_leg + left_leg;
  else if (joint >= right_arm && joint < left_leg)
    from = joint - right_arm + left_arm;
  const MocopiJoint& at = table[static_cast<std::size_t>(from)];
  return {from == joint ? at.x : -at.x, at.y, at.z};
}

int mocopi_bone(int joint) {
  const Bone bone = table[static_cast<std::size_t>(joint)].bone;
  return bone == Bone::jaw ? -1 : index_of(bone);
}

}  // namespace gait::osc
