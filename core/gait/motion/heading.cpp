#include "gait/motion/heading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gait {

namespace {

// A root that travels less than this share of a leg's length per cycle has no direction of travel.
constexpr double still_travel_per_leg = 0.3;

double unwrapped(double angle, double near) {
  return angle - 2 * std::numbers::pi * std::round((angle - near) / (2 * std::numbers::pi));
}

}  // namespace

std::vector<double> centred_heading(const WorldPoses& world, const JointRoles& roles, int joints,
                                    double frame_rate, double cycle_seconds) {
  const int frames = static_cast<int>(world.positions.size()) / joints;
  const int window = std::clamp(static_cast<int>(std::lround(cycle_seconds * frame_rate)), 1,
                                std::max(1, frames - 1));
  const auto position = [&](int frame, int joint) -> const Eigen::Vector3d& {
    return world.positions[static_cast<std::size_t>(frame) * joints + joint];
  };
  const double leg =
      frames == 0 ? 1.0
                  : (position(0, roles.left.thigh) - position(0, roles.left.shank)).norm() +
                        (position(0, roles.left.shank) - position(0, roles.left.foot)).norm();

  std::vector<double> heading(frames);
  for (int frame = 0; frame < frames; ++frame) {
    const int begin = std::clamp(frame - window / 2, 0, std::max(0, frames - 1 - window));
    const int end = std::min(begin + window, frames - 1);
    Eigen::Vector3d facing = Eigen::Vector3d::Zero();
    for (int i = begin; i <= end; ++i) {
      const Eigen::Vector3d across = position(i, roles.left.thigh) - position(i, roles.right.thigh);
      facing += Eigen::Vector3d(-across.z(), 0, across.x()).normalized();
    }
    Eigen::Vector3d travel = position(end, roles.hips) - position(begin, roles.hips);
    travel.y() = 0;
    if (travel.norm() < still_travel_per_leg * leg)
      travel = facing;
    else if (travel.dot(facing) < 0)  // walking backwards: the body still faces its heading
      travel = -travel;
    const double angle = std::atan2(travel.x(), travel.z());
    heading[frame] = frame == 0 ? angle : unwrapped(angle, heading[frame - 1]);
  }
  return heading;
}

}  // namespace gait
