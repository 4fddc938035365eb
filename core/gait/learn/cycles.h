// Cycles cut from captured walks and brought to the same number of frames (T10 §4).
#pragma once

#include <string>
#include <vector>

#include "gait/learn/walk_sequences.h"
#include "gait/model/body_pose.h"

namespace gait {

struct CapturedCycle {
  Eigen::VectorXd values;  // pose vectors at phases k / frames, frame after frame, three per joint
  double duration = 0;     // seconds
  double speed = 0;        // m/s along the ground, or of the feet on a treadmill
  double leg_length = 0;   // thigh + shank of the walk's body, metres
  int walk = 0;            // index into the walks
  int place = 0;           // number of the cycle in its walk, from 0; neighbours differ by one
  bool straight = true;    // heading changes by less than 10 degrees
};

// The body's joints that move with the pelvis: all but those above the hips.
std::vector<int> joints_below_hips(const Body& body);

// Cuts all cycles of the walks and resamples each step by SLERP to half of `frames` (even), so that
// phase 0 is the right contact and 0.5 the left. Poses are relative to the body's references, and
// the hips' rotation is without heading. Walks without a cycle give none. Throws Error for walks
// that do not fit the body.
std::vector<CapturedCycle> cut_cycles(const std::vector<Walk>& walks, const Body& body, int frames,
                                      const RoleTable& roles = {});

}  // namespace gait
