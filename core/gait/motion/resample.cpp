#include "gait/motion/resample.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gait/error.h"
#include "gait/motion/rotation.h"

namespace gait {
namespace {

constexpr double rate_tolerance = 1e-4;

void check_rate(double rate, const std::string& whose, const std::string& clip) {
  if (std::isfinite(rate) && rate > 0) return;
  throw Error(clip + ": " + whose + " must be a positive number of frames per second, found " +
              std::to_string(rate));
}

// Old frames per new frame; exact where the rates were meant to be whole multiples of each other.
double frames_per_frame(double old_rate, double new_rate) {
  const double ratio = old_rate / new_rate;
  const double whole = std::round(std::max(ratio, 1 / ratio));
  const double meant = ratio >= 1 ? whole : 1 / whole;
  return std::abs(ratio / meant - 1) < rate_tolerance ? meant : ratio;
}

}  // namespace

Clip resampled(const Clip& clip, double frame_rate) {
  check_rate(clip.frame_rate, "the clip's frame rate", clip.name);
  check_rate(frame_rate, "the frame rate to resample to", clip.name);

  Clip result;
  result.name = clip.name;
  result.skeleton = clip.skeleton;
  result.frame_rate = frame_rate;
  if (clip.frames() == 0) return result;

  const int last = clip.frames() - 1;
  const double stride = frames_per_frame(clip.frame_rate, frame_rate);
  // A hair is allowed at the end, so that rounding does not lose the last frame.
  result.resize(static_cast<int>(std::floor(last / stride + 1e-6)) + 1);
  for (int frame = 0; frame < result.frames(); ++frame) {
    const double position = std::min(frame * stride, static_cast<double>(last));
    int before = static_cast<int>(position);
    double share = position - before;
    if (share > 1 - 1e-9) {  // 1/3 * 3 may fall a bit short of the frame that it means
      ++before;
      share = 0;
    } else if (share < 1e-9) {
      share = 0;
    }
    const int after = std::min(before + 1, last);
    for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
      auto& rotation = result.pose(frame)[joint];
      auto& translation = result.translation(frame)[joint];
      rotation = clip.pose(before)[joint];
      translation = clip.translation(before)[joint];
      if (share == 0) continue;
      rotation = slerp(rotation, clip.pose(after)[joint], share);
      translation += share * (clip.translation(after)[joint] - translation);
    }
  }
  return result;
}

}  // namespace gait
