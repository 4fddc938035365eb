// Pelvis, trunk, head and arms of a style: the mean gait's curves, changed in posture, range and
// timing.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "gait/corpus/mean_gait.h"
#include "gait/corpus/smooth_curve.h"
#include "gait/corpus/walk_style.h"

namespace gait {

// Phase at which the right foot stands under the body.
inline constexpr double mid_stance = 0.28;

class UpperBody {
 public:
  // Varies over `steps` steps counted from `first_step`; `stream` names the take among all.
  UpperBody(const WalkStyle& style, std::uint64_t seed, const std::string& stream, int first_step,
            int steps);

  // The local rotations of the first twelve joints of mean_body (hips to right forearm) at a phase
  // in cycles, counted on from cycle to cycle.
  void pose(double phase, std::span<Eigen::Quaterniond> rotations) const;

 private:
  struct Arm {
    ApproximatingCurve forward, spread, twist, elbow, range, lag;
  };
  void pose_arm(const Arm& arm, bool left, double phase, double step,
                std::span<Eigen::Quaterniond> shoulder_arm_forearm) const;

  WalkStyle style_;
  std::array<MeanGaitCurve, 6> trunk_;  // hips, spine, spine1, spine2, neck, head
  MeanGaitCurve arm_curve_, forearm_curve_;
  ApproximatingCurve lean_, roll_, turn_, slump_, nod_, head_turn_, head_roll_, range_;
  Arm left_, right_;
};

}  // namespace gait
