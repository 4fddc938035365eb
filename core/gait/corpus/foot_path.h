// The path of one foot: fixed to the ground in stance, rolling from heel to ball, and in an arc
// from print to print in swing. Nothing slides and nothing sinks, by construction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gait/corpus/smooth_curve.h"
#include "gait/corpus/walk_style.h"

namespace gait {

// The sole: a plate below the ankle. Metres.
struct Sole {
  double ankle_height, ball, heel;  // above the sole; before and behind the ankle
};

// Where a foot stands, flat: its heel on the ground, and its yaw (0 along +Z, above 0 towards +X).
struct Footprint {
  double x = 0, z = 0, yaw = 0;  // metres, radians
  double time = 0;               // of contact, seconds
  double lift = 1;               // times the style's, in the swing that leads away from here
};

struct FootState {
  Eigen::Vector3d ankle;  // metres
  double pitch, yaw;      // radians; pitch above 0: toes down
};

class FootPath {
 public:
  // `outward`: +1 for a left foot, -1 for a right one. `prints` in order, one a cycle.
  FootPath(const WalkStyle& style, const Sole& sole, double outward, std::vector<Footprint> prints);

  // `cycles`: cycles since the first print; i at the contact of print i. `range` scales the pitch
  // about its value in stance.
  FootState at(double cycles, double range) const;

 private:
  Eigen::Vector3d ankle_over(const Footprint& print, double pitch, bool on_ball) const;
  double clearance(double swing, double lift, double swing_seconds) const;

  WalkStyle style_;
  Sole sole_;
  double outward_;
  std::vector<Footprint> prints_;
  ShapedCurve pitch_;
};

}  // namespace gait
