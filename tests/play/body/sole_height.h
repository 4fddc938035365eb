// How high the feet of a clip are: the lowest point of either, joints and tips alike.
#pragma once

#include <algorithm>
#include <vector>

#include "gait/motion/joint_roles.h"
#include "gait/motion/kinematics.h"

namespace gait::testing {

// Frame by frame, metres.
inline std::vector<double> lowest_points(const Clip& clip, const JointRoles& roles) {
  const WorldPoses world = world_poses(clip);
  const int joints = clip.skeleton.size();
  std::vector<double> lowest(static_cast<std::size_t>(clip.frames()), 1e9);
  for (int joint = 0; joint < joints; ++joint) {
    if (!clip.skeleton.is_in_branch(joint, roles.right.foot) &&
        !clip.skeleton.is_in_branch(joint, roles.left.foot))
      continue;
    for (int frame = 0; frame < clip.frames(); ++frame) {
      const std::size_t at = static_cast<std::size_t>(frame) * joints + joint;
      lowest[frame] = std::min(lowest[frame], world.positions[at].y());
      for (const Eigen::Vector3d& tip : clip.skeleton.joints[joint].tips)
        lowest[frame] =
            std::min(lowest[frame], (world.positions[at] + world.rotations[at] * tip).y());
    }
  }
  return lowest;
}

inline double lowest_of(const Clip& clip, const JointRoles& roles) {
  const std::vector<double> points = lowest_points(clip, roles);
  return *std::min_element(points.begin(), points.end());
}

}  // namespace gait::testing
