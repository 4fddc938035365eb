// Leg angles that bring the ankle where the foot path wants it: two bones and a hinge.
#pragma once

#include <Eigen/Geometry>

#include "gait/motion/two_bone.h"

namespace gait {

struct LegAngles {
  Eigen::Quaterniond thigh;  // in the world
  double knee;               // radians, 0 straight, above 0 the shank goes back
};

// `leg`: thigh and shank, metres. The knee bends towards `forward_yaw` (0: +Z, above 0 towards +X).
LegAngles solve_leg(const TwoBones& leg, const Eigen::Vector3d& hip, const Eigen::Vector3d& ankle,
                    double forward_yaw);

}  // namespace gait
