// One synthetic walk as a continuous function of time: sample it at any frame rate.
//
// Feet come first: prints on the ground and arcs between them. The pelvis follows them (place
// between the feet, height such that the standing knee bends as the mean gait's does), and the legs
// follow both by inverse kinematics. The world is Y up with the ground at 0; the walk goes along
// +Z.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gait/corpus/foot_path.h"
#include "gait/corpus/leg_solver.h"
#include "gait/corpus/upper_body.h"
#include "gait/corpus/walk_style.h"
#include "gait/motion/skeleton.h"
#include "gait/motion/steps.h"

namespace gait {

// From `seconds` after the first counted contact on, steps last 1 / `scale` of the style's.
struct CadenceChange {
  double seconds = 0;
  double scale = 1;
};

struct WalkPlan {
  WalkStyle style;
  int cycles = 5;  // from the first counted right contact to the last
  std::uint64_t seed = 1;
  int take = 1;  // another take of the same seed is another passage of the same actor
  double leg_length = corpus_leg_length;  // hip to ankle, metres
  std::vector<CadenceChange> cadence{};   // by time
};

class SyntheticWalk {
 public:
  // Throws Error when the plan has no cycles, or a leg length or cadence that is not positive.
  explicit SyntheticWalk(const WalkPlan& plan);

  // Seconds from the first frame to the last moment drawn: some nine tenths of a step before the
  // first counted contact, half a step after the last.
  double duration() const { return duration_; }

  struct TimedContact {
    double time;  // seconds
    Foot foot;
  };
  // All contacts within the duration; the first and last counted ones are right.
  const std::vector<TimedContact>& contacts() const { return contacts_; }

  // 0..1, 0 at a right contact, 0.5 at a left one, linear between.
  double phase(double seconds) const;

  const Skeleton& skeleton() const { return skeleton_; }

  // Local rotations of all joints; returns the hips' place (m).
  Eigen::Vector3d pose(double seconds, std::span<Eigen::Quaterniond> rotations) const;

 private:
  void lay_prints(const WalkPlan& plan);
  void lay_pelvis();
  FootState foot_at(Foot foot, double drawn_phase) const;
  double foot_cycles(Foot foot, double drawn_phase) const;
  Eigen::Vector3d pelvis_over_ground(double time, double drawn_phase) const;
  double wanted_height(double time, double drawn_phase, double& limit) const;

  Skeleton skeleton_;
  WalkStyle style_;
  TwoBones leg_;
  Sole sole_;
  int first_step_, steps_;  // steps are counted from the first counted contact
  double duration_ = 0, start_ = 0;
  std::vector<double> times_;  // of all contacts drawn, also before and after the clip
  std::vector<TimedContact> contacts_;
  InterpolatingCurve phase_;  // of time: what joints are drawn with, smooth where `phase` has kinks
  std::vector<FootPath> feet_;  // right, left
  UpperBody upper_body_;
  ApproximatingCurve pitch_range_, knee_, sway_range_;
  MeanGaitCurve knee_curve_;
  double knee_mean_ = 0;  // of the mean gait in stance
  InterpolatingCurve pelvis_x_, pelvis_z_;
  ApproximatingCurve pelvis_y_;
};

}  // namespace gait
