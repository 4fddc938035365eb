// A walk in the shape that some exporter gives it: renamed, re-rooted, re-ordered, in other units
// and axes, its bones in channels, a rest pose first. What it is must not depend on that.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "gait/files/bvh.h"
#include "gait/motion/clip.h"
#include "gait/motion/joint_roles.h"

namespace gait::testing {

struct Mutation {
  std::string told;         // what was done, for messages
  BvhFile file;             // the mutated walk
  double leg_factor = 1;    // its legs over the walk's
  double frame_factor = 1;  // its frames per second over the walk's
  int first_row = 0;        // the row that is the walk's frame 0
  Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();  // from the walk's to the file's
  double metres_per_unit = 1;
  std::map<Role, std::string> names;  // of the first joint of each role
};

// One of endless many. `walk`: metres, Y up, its root the hips.
Mutation mutated(const Clip& walk, std::uint64_t seed);

}  // namespace gait::testing
