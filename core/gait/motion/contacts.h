// Contacts of a captured walk, found by looking at all of it (Zeni et al. 2008): a foot touches
// when it is farthest ahead of the hips along the heading.
#pragma once

#include <vector>

#include "gait/motion/clip.h"
#include "gait/motion/joint_roles.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/steps.h"

namespace gait {

// What a walk's own kinematics say about it. One entry per frame where there are several.
struct WalkTrack {
  WorldPoses world;             // metres, Y up; frame after frame, one entry per joint
  std::vector<double> heading;  // radians, unwrapped
  std::vector<Contact> contacts;
  double cycle_seconds = 1.1;  // median time from contact to the same foot's next contact
  double speed = 0;            // m/s along the ground, also backwards
  bool treadmill = false;      // the root stays where it is while the feet travel
  double leg_length = 0;       // thigh + shank, metres
};

// Follows a clip in metres with Y up. Throws Error when hips, thighs, shanks or feet are missing; a
// clip without steps has no contacts and that is no error.
WalkTrack follow_walk(const Clip& clip, const JointRoles& roles);

// Cycles during which the heading changes by less than `limit` radians (T10 §3).
std::vector<Cycle> straight_cycles(const WalkTrack& track, double limit = 0.17453);

}  // namespace gait
