#include "gait/corpus/leg_solver.h"

#include <cmath>

namespace gait {

LegAngles solve_leg(const TwoBones& leg, const Eigen::Vector3d& hip, const Eigen::Vector3d& ankle,
                    double forward_yaw) {
  const Eigen::Vector3d along = (ankle - hip).normalized();
  const double distance = (ankle - hip).norm();
  const Eigen::Vector3d forward(std::sin(forward_yaw), 0, std::cos(forward_yaw));
  const Eigen::Vector3d bend = (forward - along * forward.dot(along)).normalized();
  const double knee = leg.bend_at(distance);
  // The thigh points off the line to the ankle, forward, by the triangle's angle at the hip.
  const double off = leg.angle_off(knee);
  Eigen::Matrix3d axes;
  axes.col(1) = -(std::cos(off) * along + std::sin(off) * bend);
  axes.col(0) = bend.cross(along);
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return {Eigen::Quaterniond(axes), knee};
}

}  // namespace gait
