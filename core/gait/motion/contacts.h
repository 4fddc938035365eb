// Contacts of a captured walk, found from the whole clip (Zeni et al. 2008): a foot touches the
// ground when it is farthest ahead of the hips along the heading. Between frames a parabola through
// the farthest place and its neighbours says when.
#pragma once

#include <vector>

#include "gait/motion/clip.h"
#include "gait/motion/joint_roles.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/steps.h"

namespace gait {

// Quantities of a walk that follow from its kinematics. Vectors without another comment have one
// entry per frame.
struct WalkTrack {
  WorldPoses world;             // metres, Y up; frame after frame, one entry per joint
  std::vector<double> heading;  // radians, unwrapped
  std::vector<Contact> contacts;
  double cycle_seconds = 1.1;  // median time from contact to the same foot's next contact
  double speed = 0;            // m/s along the ground, positive when walking backwards too
  bool treadmill = false;      // the root stays in place while the feet travel
  double leg_length = 0;       // thigh + shank, metres
};

// Follows a clip in metres with Y up. Throws Error when hips, thighs, shanks or feet are missing. A
// clip without steps has no contacts; that is not an error.
WalkTrack follow_walk(const Clip& clip, const JointRoles& roles);

// Cycles during which the heading changes by less than `limit` radians (T10 §3).
std::vector<Cycle> straight_cycles(const WalkTrack& track, double limit = 0.17453);

}  // namespace gait
