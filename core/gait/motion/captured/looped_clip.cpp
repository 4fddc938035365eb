#include "gait/motion/captured/looped_clip.h"

#include <algorithm>
#include <numbers>

#include "gait/motion/rotation.h"

namespace gait {

namespace {

constexpr int shortest_loop = 8;  // frames
constexpr double degree = std::numbers::pi / 180;
constexpr double same_pose = 1.5 * degree, other_pose = 10 * degree;  // of the joint farthest off
constexpr double same_height = 0.02;                                  // of the root's

double farthest_turn(const Clip& clip, int a, int b) {
  double farthest = 0;
  for (int joint = 0; joint < clip.skeleton.size(); ++joint)
    farthest = std::max(farthest, angle_between(clip.pose(a)[joint], clip.pose(b)[joint]));
  return farthest;
}

}  // namespace

bool loops(const Clip& clip) {
  const int last = clip.frames() - 1;
  if (last < shortest_loop || farthest_turn(clip, 0, last) > same_pose) return false;
  for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
    const double rise = clip.translation(last)[joint].y() - clip.translation(0)[joint].y();
    if (clip.skeleton.joints[joint].parent < 0 &&
        std::abs(rise) > same_height * std::abs(clip.translation(0)[joint].y()) + 1e-9)
      return false;
  }
  for (int frame = 1; frame < last; ++frame)
    if (farthest_turn(clip, 0, frame) > other_pose) return true;
  return false;
}

Clip unrolled(const Clip& clip, int passes) {
  const int period = clip.frames() - 1;
  Clip result = clip;
  result.resize(passes * period + 1);
  for (int frame = 0; frame < result.frames(); ++frame) {
    const int pass = std::min(frame / period, passes - 1), from = frame - pass * period;
    std::copy(clip.pose(from).begin(), clip.pose(from).end(), result.pose(frame).begin());
    for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
      result.translation(frame)[joint] = clip.translation(from)[joint];
      if (clip.skeleton.joints[joint].parent >= 0) continue;
      Eigen::Vector3d travel = clip.translation(period)[joint] - clip.translation(0)[joint];
      travel.y() = 0;
      result.translation(frame)[joint] += pass * travel;
    }
  }
  return result;
}

}  // namespace gait
