// The mean human walk: each joint's rotation as a Fourier series in the gait phase, linear in
// speed.
//
// Fitted to 69 straight walks of 14 subjects of the CMU Graphics Lab Motion Capture Database
// (mocap.cs.cmu.edu, free for all uses; created with funding from NSF EIA-0196217). Phase 0 is the
// right foot's contact; speed is in leg lengths per second, leg length being thigh + shank.
// Rotations are rotation vectors (radians) from the rest pose: T-pose, legs straight down, all
// joint frames aligned with the world, X to the walker's left, Y up, Z forward.
#pragma once

#include <Eigen/Core>

#include "gait/motion/skeleton.h"

namespace gait {

// The joints of the series the corpus uses: trunk and head, the left arm and the left knee. Right
// limbs are their mirror image half a cycle later. Hip and ankle angles follow from the feet.
enum class MeanJoint { hips, spine, spine1, spine2, neck, head, left_arm, left_forearm, left_knee };

// The series counts phase from where the foot is farthest ahead of the hips, which comes this much
// of a cycle before it meets the ground.
inline constexpr double mean_gait_lead = 0.012;

inline constexpr double mean_gait_slowest =
    0.96;  // the speeds the walks had, leg lengths per second
inline constexpr double mean_gait_fastest = 2.34;

// One joint's rotation over the cycle at one speed.
class MeanGaitCurve {
 public:
  // `speed` in leg lengths per second; outside the fitted range the nearest fitted speed is taken.
  MeanGaitCurve(MeanJoint joint, double speed);

  // Rotation vector at any phase (cycles from the right foot's touch, periodic), and its mean over
  // the cycle.
  Eigen::Vector3d at(double phase) const;
  Eigen::Vector3d mean() const { return coefficients_.col(0); }

 private:
  Eigen::Matrix<double, 3, 9>
      coefficients_;  // of 1, cos p, sin p, ... cos 4p, sin 4p; p = 2 pi phase
};

// Cycles per second at a speed in leg lengths per second: 0.7516 V^0.4077.
double mean_gait_frequency(double speed);

// The body: 18 joints, offsets of the mean CMU subject, left and right made equal, scaled to a leg
// of `leg_length` metres from hip to ankle. Head, forearms and feet end in tips; a foot has two,
// heel and ball, which are the ends of its sole.
Skeleton mean_body(double leg_length);

}  // namespace gait
