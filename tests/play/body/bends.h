// How far knees and elbows bend: angles between the bones above and below, radians.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gait/learn/walk_sequences.h"
#include "gait/motion/kinematics.h"

namespace gait::testing {

// Left knee, right knee, left elbow, right elbow; knees below zero when they bend the wrong way,
// elbows 0 on a body without hands. `roles`: one per joint of the clip.
inline std::array<double, 4> bends_at(const Clip& clip, const std::vector<Role>& roles,
                                      const WorldPoses& world, int frame) {
  const auto find = [&](Role role) { return std::find(roles.begin(), roles.end(), role); };
  const auto place = [&](Role role) {
    return world.positions[static_cast<std::size_t>(frame) * clip.skeleton.joints.size() +
                           static_cast<std::size_t>(find(role) - roles.begin())];
  };
  const auto bend = [&](Role a, Role b, Role c) {
    if (find(c) == roles.end()) return 0.0;
    const Eigen::Vector3d above = place(b) - place(a), below = place(c) - place(b);
    return std::atan2(above.cross(below).norm(), above.dot(below));
  };
  const Eigen::Vector3d leftward = place(Role::left_thigh) - place(Role::right_thigh);
  const auto knee = [&](Role a, Role b, Role c) {
    const Eigen::Vector3d axis = (place(b) - place(a)).cross(place(c) - place(b));
    return std::copysign(bend(a, b, c), axis.dot(leftward));
  };
  return {knee(Role::left_thigh, Role::left_shank, Role::left_foot),
          knee(Role::right_thigh, Role::right_shank, Role::right_foot),
          bend(Role::left_arm, Role::left_forearm, Role::left_hand),
          bend(Role::right_arm, Role::right_forearm, Role::right_hand)};
}

struct BendRange {
  std::array<double, 4> least{9, 9, 9, 9}, most{-9, -9, -9, -9};

  void see(const Clip& clip, const std::vector<Role>& roles) {
    const WorldPoses world = world_poses(clip);
    for (int frame = 0; frame < clip.frames(); ++frame) {
      const auto bends = bends_at(clip, roles, world, frame);
      for (std::size_t i = 0; i < bends.size(); ++i) {
        least[i] = std::min(least[i], bends[i]);
        most[i] = std::max(most[i], bends[i]);
      }
    }
  }
  // By how much another range goes beyond this one; below zero: how far within it stays.
  double exceeded_by(const BendRange& other) const {
    double most_beyond = -9;
    for (std::size_t i = 0; i < least.size(); ++i)
      if (most[i] > least[i])
        most_beyond = std::max({most_beyond, least[i] - other.least[i], other.most[i] - most[i]});
    return most_beyond;
  }
};

inline BendRange bends_of(const std::vector<Walk>& walks) {
  BendRange range;
  for (const Walk& walk : walks) range.see(walk.clip, find_roles(walk.clip.skeleton).of_joint);
  return range;
}

}  // namespace gait::testing
