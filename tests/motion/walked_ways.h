// Built-in walks led along other ways than straight ahead.
#pragma once

#include <cmath>
#include <numbers>

#include "gait/corpus/corpus.h"
#include "gait/motion/joint_roles.h"
#include "gait/motion/rotation.h"

namespace gait::testing {

inline CorpusWalk walk_in(const std::string& style, int cycles = 6, int take = 1) {
  WalkPlan plan;
  plan.style = corpus_style(style);
  plan.cycles = cycles;
  plan.take = take;
  return make_walk(plan);
}

// The same walk on a rig with one more joint half-way to `joint`, which never turns.
inline Clip with_joint_before(const Clip& clip, int joint) {
  Clip split = clip;
  std::vector<Joint>& joints = split.skeleton.joints;
  for (Joint& other : joints)
    if (other.parent >= joint) ++other.parent;
  const Eigen::Vector3d half = joints[joint].offset / 2;
  joints.insert(joints.begin() + joint,
                Joint{"Helper" + std::to_string(joint), joints[joint].parent, half, {}});
  joints[joint + 1].parent = joint;
  joints[joint + 1].offset = half;
  split.resize(clip.frames());
  for (int frame = 0; frame < clip.frames(); ++frame)
    for (int to = 0; to < split.skeleton.size(); ++to) {
      const int from = to > joint ? to - 1 : to;
      split.pose(frame)[to] = to == joint ? Eigen::Quaterniond::Identity() : clip.pose(frame)[from];
      split.translation(frame)[to] =
          to == joint || to == joint + 1 ? half : clip.translation(frame)[from];
    }
  return split;
}

// The same walk on a rig whose legs have joints between thigh and shank, and shank and foot.
inline Clip with_joints_in_legs(Clip clip) {
  for (const char* name : {"left shank", "left foot", "right shank", "right foot"})
    clip = with_joint_before(clip, find_roles(clip.skeleton).joint(*role_from_name(name)));
  return clip;
}

// The whole walk turned about the vertical.
inline Clip turned(Clip clip, double angle) {
  for (int frame = 0; frame < clip.frames(); ++frame) {
    clip.pose(frame)[0] = about_vertical(angle) * clip.pose(frame)[0];
    clip.translation(frame)[0] = about_vertical(angle) * clip.translation(frame)[0];
  }
  return clip;
}

// The same steps back to where they came from.
inline Clip backwards(const Clip& clip) {
  Clip reversed = clip;
  for (int frame = 0; frame < clip.frames(); ++frame) {
    const int from = clip.frames() - 1 - frame;
    std::copy(clip.pose(from).begin(), clip.pose(from).end(), reversed.pose(frame).begin());
    std::copy(clip.translation(from).begin(), clip.translation(from).end(),
              reversed.translation(frame).begin());
  }
  return reversed;
}

// The belt takes away what the root travels over the whole walk.
inline Clip on_treadmill(Clip clip) {
  const Eigen::Vector3d begin = clip.translation(0)[0];
  const Eigen::Vector3d travel = clip.translation(clip.frames() - 1)[0] - begin;
  for (int frame = 0; frame < clip.frames(); ++frame) {
    const double share = static_cast<double>(frame) / (clip.frames() - 1);
    clip.translation(frame)[0].x() -= share * travel.x();
    clip.translation(frame)[0].z() -= share * travel.z();
  }
  return clip;
}

// Bent into a circle of the given radius (metres), the walk's travel becoming arc.
inline Clip around(Clip clip, double radius) {
  for (int frame = 0; frame < clip.frames(); ++frame) {
    Eigen::Vector3d& place = clip.translation(frame)[0];
    const double angle = place.z() / radius;
    const double out = radius - place.x();
    place = {radius - out * std::cos(angle), place.y(), out * std::sin(angle)};
    clip.pose(frame)[0] = about_vertical(angle) * clip.pose(frame)[0];
  }
  return clip;
}

}  // namespace gait::testing
