// The joints of Sony mocopi: names, parents and rest offsets by their numbers (from Sony's
// technical specifications and the sample packets of t-34400/mocopi_protocol_supplement). At rest
// no joint is rotated, in the T-pose. Right-handed, Y up, facing +Z, metres.
#pragma once

#include <Eigen/Core>

namespace gait::osc {

inline constexpr int mocopi_joints = 27;

int mocopi_parent(int joint);  // -1 for the root
Eigen::Vector3d mocopi_offset(int joint);
int mocopi_bone(int joint);  // a humanoid's; -1: a joint between bones

}  // namespace gait::osc
