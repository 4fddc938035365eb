#include "gait/motion/captured/rest_rows.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gait/motion/kinematics.h"

namespace gait {

namespace {

// In shares of the 95th percentile of the motion's own changes.
constexpr double least_jump = 2.5;       // no limb of a walker sets off so suddenly
constexpr double least_jump_bare = 1.2;  // where all rotations before it are nought
constexpr double least_change = 0.4;     // radians over all joints; a walk's first frame may settle
constexpr double most_held = 0.25;       // a held pose may tremble
constexpr int fewest_moving = 8;         // frames behind the jump, to compare it with
constexpr double bare = 2e-4;            // radians; rounding, in a row of noughts

// A body's height in the clip's unit, in one frame.
double height_in(const Clip& clip, int frame) {
  std::vector<Eigen::Quaterniond> world(clip.skeleton.joints.size());
  std::vector<Eigen::Vector3d> places(world.size());
  forward_kinematics(clip.skeleton, clip.pose(frame), clip.translation(frame), world, places);
  double height = 0;
  for (const Eigen::Vector3d& place : places) height = std::max(height, (place - places[0]).norm());
  return height;
}

// From each frame to the next: the root of the sum of squares of all joints' turns (radians) and of
// the roots' moves (in heights from the root, which is about half a body's).
std::vector<double> changes_of(const Clip& clip) {
  const double size = height_in(clip, clip.frames() / 2);
  std::vector<double> changes(clip.frames() - 1);
  for (int frame = 0; frame + 1 < clip.frames(); ++frame) {
    double sum = 0;
    for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
      // The turn's square where it is small, and nearly so elsewhere.
      const double cosine = clip.pose(frame)[joint].dot(clip.pose(frame + 1)[joint]);
      sum += 4 * std::max(0.0, 1 - cosine * cosine);
      if (clip.skeleton.joints[joint].parent >= 0 || !(size > 0)) continue;
      sum += (clip.translation(frame + 1)[joint] - clip.translation(frame)[joint]).squaredNorm() /
             (size * size);
    }
    changes[frame] = std::sqrt(sum);
  }
  return changes;
}

double usual_change(std::vector<double> changes) {
  const auto at = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() * 95 / 100);
  std::nth_element(changes.begin(), at, changes.end());
  return *at;
}

bool is_bare(const Clip& clip, int frame) {
  return std::all_of(
      clip.pose(frame).begin(), clip.pose(frame).end(),
      [](const Eigen::Quaterniond& rotation) { return rotation.vec().norm() < bare; });
}

// How many frames lie before the jump; 0 where there is none. `edge`: the clip's frame at this end.
int held_frames(const Clip& clip, const std::vector<double>& changes, int edge) {
  // Nearly all of a clip may be held: the motion is what changes at all.
  std::vector<double> moving;
  const double most = *std::max_element(changes.begin(), changes.end());
  for (const double change : changes)
    if (change > 1e-3 * most) moving.push_back(change);
  if (static_cast<int>(moving.size()) < fewest_moving) return 0;
  const double held = most_held * usual_change(moving);
  const auto jump =
      std::find_if(changes.begin(), changes.end(), [&](double change) { return change > held; });
  if (changes.end() - jump <= fewest_moving) return 0;
  const double least = is_bare(clip, edge) ? least_jump_bare : least_jump;
  if (*jump < least_change || *jump < least * usual_change({jump + 1, changes.end()})) return 0;
  return static_cast<int>(jump - changes.begin()) + 1;
}

std::string frames_told(int first, int count) {
  return count == 1 ? "the row of frame " + std::to_string(first)
                    : "the rows of frames " + std::to_string(first) + " to " +
                          std::to_string(first + count - 1);
}

}  // namespace

MovingRows moving_rows(const Clip& clip) {
  MovingRows rows{0, clip.frames()};
  if (clip.frames() <= fewest_moving + 1) return rows;
  std::vector<double> changes = changes_of(clip);
  rows.begin = held_frames(clip, changes, 0);
  changes.erase(changes.begin(), changes.begin() + rows.begin);
  std::reverse(changes.begin(), changes.end());
  if (static_cast<int>(changes.size()) > fewest_moving)
    rows.end -= held_frames(clip, changes, clip.frames() - 1);
  return rows;
}

Clip rows_of(const Clip& clip, const MovingRows& rows) {
  if (rows.are_all_of(clip)) return clip;
  Clip result;
  result.name = clip.name;
  result.skeleton = clip.skeleton;
  result.frame_rate = clip.frame_rate;
  const auto joints = static_cast<std::ptrdiff_t>(clip.skeleton.joints.size());
  result.rotations.assign(clip.rotations.begin() + rows.begin * joints,
                          clip.rotations.begin() + rows.end * joints);
  result.translations.assign(clip.translations.begin() + rows.begin * joints,
                             clip.translations.begin() + rows.end * joints);
  return result;
}

std::optional<std::string> rest_rows_told(const Clip& clip, const MovingRows& rows) {
  if (rows.are_all_of(clip)) return std::nullopt;
  std::string which;
  if (rows.begin > 0) which = frames_told(0, rows.begin);
  if (rows.end < clip.frames())
    which += (which.empty() ? "" : " and ") + frames_told(rows.end, clip.frames() - rows.end);
  return clip.name + ": " + which +
         ": a rest pose, parted from the motion by a jump; the motion is taken without";
}

}  // namespace gait
