// Calibration poses: the rotations of a rig's joints when its body stands in the T-pose (arms out
// to the sides) or the I-pose (arms hanging). A live sender in the same pose is set equal to them,
// so the rest poses of both rigs may differ.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "gait/motion/joint_roles.h"
#include "gait/motion/skeleton.h"

namespace gait {

enum class CalibrationPose { t, i };

// Rotation of every joint in the world, the body facing +Z. `usual`: local rotations of a natural
// pose of this rig, such as the mean of a walk, the hips' without heading. Arms and legs are swung
// from it the shortest way, so their twist stays a person's; the trunk keeps that pose. Skeleton in
// metres. Throws Error when hips or legs are missing (JointRoles::has_legs).
std::vector<Eigen::Quaterniond> calibration_pose(const Skeleton& skeleton, const JointRoles& roles,
                                                 std::span<const Eigen::Quaterniond> usual,
                                                 CalibrationPose pose);

}  // namespace gait
