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
  double root_speed = 0;       // m/s of the hips along the heading, negative backwards
  double feet_speed = 0;       // m/s at which standing feet fall behind the hips
  bool treadmill = false;      // the root stays in place while the feet travel
  double leg_length = 0;       // thigh + shank, metres
};

// Follows a clip in metres with Y up. Throws Error when hips, thighs, shanks or feet are missing. A
// clip without steps has no contacts; that is not an error.
WalkTrack follow_walk(const Clip& clip, const JointRoles& roles);

// Cycles per second that legs fall into at a speed in leg lengths per second: Inman's law f = 0.743
// sqrt(V) (G04 eq. 4), which holds for grown legs of 0.83 m; others swing by dynamic similarity,
// times (0.83 m / leg)^(1/4). 142 captured walks lie between 0.85 and 1.39 of it.
double natural_frequency(double speed_per_leg, double leg_length);

// Whether the heading changes by less than `limit` radians during a cycle, and the cycles in which
// it does (T10 §3).
bool is_straight(const WalkTrack& track, const Cycle& cycle, double limit = 0.17453);
std::vector<Cycle> straight_cycles(const WalkTrack& track, double limit = 0.17453);

}  // namespace gait
