// The joints of Rokoko Studio's live JSON: names and, in Unity's axes, the rotations in the world
// that they have in the T-pose (from the official plugins' reference pose).
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace gait::osc {

// A humanoid's bone by Rokoko's name; -1: none.
int rokoko_bone(const std::string& joint);
// Rokoko's name of a bone; empty: it has none.
std::string rokoko_joint(int bone);
Eigen::Quaterniond rokoko_t_pose(int bone);

}  // namespace gait::osc
