// Calibration poses: how a rig's joints are turned when its body stands in the T-pose (arms out to
// the sides) or the I-pose (arms hanging). What a live sender is at the same moment is set equal to
// it, so that both need not rest alike.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "gait/motion/joint_roles.h"
#include "gait/motion/skeleton.h"

namespace gait {

enum class CalibrationPose { t, i };

// World rotation of every joint, the body looking along +Z. `usual`: local rotations of a pose the
// rig really takes (the mean of a walk; the hips' with heading out), from which arms and legs are
// swung the shortest way, so that they are twisted as a person's are; the trunk stays as it is.
// Skeleton in metres; needs hips and legs (JointRoles::has_legs), else Error.
std::vector<Eigen::Quaterniond> calibration_pose(const Skeleton& skeleton, const JointRoles& roles,
                                                 std::span<const Eigen::Quaterniond> usual,
                                                 CalibrationPose pose);

}  // namespace gait
