// Two-bone inverse kinematics: the triangle of a thigh, a shank and the line from hip to ankle.
//
// The bend of a knee is the angle between the directions of both bones, 0 when they are in line
// (radians); lengths and distances are in one unit.
#pragma once

#include <algorithm>
#include <cmath>

namespace gait {

struct TwoBones {
  double upper, lower;  // lengths

  // Distance between the outer ends of a limb that is bent by `bend`.
  double reach(double bend) const {
    return std::sqrt(upper * upper + lower * lower + 2 * upper * lower * std::cos(bend));
  }
  // Bend that brings the outer ends to this distance. 0 where the limb is too short for it, pi
  // where both bones' lengths differ by more.
  double bend_at(double distance) const {
    const double cosine =
        (distance * distance - upper * upper - lower * lower) / (2 * upper * lower);
    return std::acos(std::clamp(cosine, -1.0, 1.0));
  }
  // Angle between the upper bone and the line from its outer end to the lower bone's.
  double angle_off(double bend) const {
    return std::atan2(lower * std::sin(bend), upper + lower * std::cos(bend));
  }
};

}  // namespace gait
