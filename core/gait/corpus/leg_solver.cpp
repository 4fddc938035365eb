#include "gait/corpus/leg_solver.h"

#include <algorithm>
#include <cmath>

namespace gait {

double hip_to_ankle(const LegLengths& leg, double knee) {
  return std::sqrt(leg.thigh * leg.thigh + leg.shank * leg.shank +
                   2 * leg.thigh * leg.shank * std::cos(knee));
}

double knee_at(const LegLengths& leg, double distance) {
  const double cosine = (distance * distance - leg.thigh * leg.thigh - leg.shank * leg.shank) /
                        (2 * leg.thigh * leg.shank);
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

LegAngles solve_leg(const LegLengths& leg, const Eigen::Vector3d& hip, const Eigen::Vector3d& ankle,
                    double forward_yaw) {
  const Eigen::Vector3d along = (ankle - hip).normalized();
  const double distance = (ankle - hip).norm();
  const Eigen::Vector3d forward(std::sin(forward_yaw), 0, std::cos(forward_yaw));
  const Eigen::Vector3d bend = (forward - along * forward.dot(along)).normalized();
  const double knee = knee_at(leg, distance);
  // The thigh points off the line to the ankle, forward, by the triangle's angle at the hip.
  const double off = std::atan2(leg.shank * std::sin(knee), leg.thigh + leg.shank * std::cos(knee));
  Eigen::Matrix3d axes;
  axes.col(1) = -(std::cos(off) * along + std::sin(off) * bend);
  axes.col(0) = bend.cross(along);
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return {Eigen::Quaterniond(axes), knee};
}

}  // namespace gait
