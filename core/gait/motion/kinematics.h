// Forward kinematics: from local rotations and translations to places in the world.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "gait/motion/clip.h"

namespace gait {

// Global rotation and position of every joint, in the unit of `translations`. All spans have one
// entry per joint of `skeleton`; the results are written in place, nothing is allocated.
void forward_kinematics(const Skeleton& skeleton, std::span<const Eigen::Quaterniond> rotations,
                        std::span<const Eigen::Vector3d> translations,
                        std::span<Eigen::Quaterniond> global_rotations,
                        std::span<Eigen::Vector3d> positions) noexcept;

// The same for every frame of a clip: frame after frame, one entry per joint.
struct WorldPoses {
  std::vector<Eigen::Quaterniond> rotations;
  std::vector<Eigen::Vector3d> positions;
};
WorldPoses world_poses(const Clip& clip);

}  // namespace gait
