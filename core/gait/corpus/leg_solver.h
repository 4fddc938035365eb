// Leg angles that bring the ankle where the foot path wants it: two bones and a hinge.
#pragma once

#include <Eigen/Geometry>

#include "gait/corpus/foot_path.h"

namespace gait {

struct LegLengths {
  double thigh, shank;  // metres
};

struct LegAngles {
  Eigen::Quaterniond thigh;  // in the world
  double knee;               // radians, 0 straight, above 0 the shank goes back
};

// Distance from hip to ankle when the knee is bent by `knee` radians, and the way back; beyond the
// leg's length the knee is straight.
double hip_to_ankle(const LegLengths& leg, double knee);
double knee_at(const LegLengths& leg, double distance);

// The knee bends towards `forward_yaw` (0: +Z, above 0 towards +X).
LegAngles solve_leg(const LegLengths& leg, const Eigen::Vector3d& hip, const Eigen::Vector3d& ankle,
                    double forward_yaw);

}  // namespace gait
