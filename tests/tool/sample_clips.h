// Clips to run the program on, written where a test wants them.
#pragma once

#include <string>

namespace gait::testing {

// A walk of the corpus in style `style`, of `cycles` cycles.
void write_walk(const std::string& path, const std::string& style = "proud", int cycles = 4);

// Something that is no body: three joints with names that say nothing, `frames` frames.
std::string arm_of_a_crane(int frames);

// A person of one frame, Z up, in inches, arms out: a rig as a game's tools write it.
std::string t_pose_z_up();

}  // namespace gait::testing
