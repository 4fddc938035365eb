// Heading: the direction of a walk, an angle about the vertical in radians, 0 along +Z, growing
// towards +X.
//
// It changes slowly by definition: it is the direction of travel over one cycle or, when the root
// hardly travels, the facing direction (the normal to the line from thigh to thigh) averaged over a
// cycle. The pelvis' own rotation within a cycle stays in the hips' rotation.
#pragma once

#include <algorithm>
#include <vector>

#include "gait/motion/joint_roles.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"

namespace gait {

// Horizontal unit vector of a heading.
inline Eigen::Vector3d heading_direction(double heading) {
  return {std::sin(heading), 0, std::cos(heading)};
}

// Facing direction of a body, from the vector between its right and its left thigh (or shoulder).
inline double heading_across(const Eigen::Vector3d& right_to_left) {
  return std::atan2(-right_to_left.z(), right_to_left.x());
}

// Unwrapped heading per frame, from a centred window of one cycle; at the clip's ends the window is
// the first or last whole one. Needs hips and both thighs (JointRoles::has_legs).
std::vector<double> centred_heading(const WorldPoses& world, const JointRoles& roles, int joints,
                                    double frame_rate, double cycle_seconds);

// Heading from the past alone, as a player needs it: the facing direction averaged over the last
// cycle. Templated on the scalar so that learning and playing share it. Never allocates after
// construction.
template <typename Scalar>
class CausalHeading {
 public:
  // For frames at a fixed rate: the average is over `window_frames`, at least 1.
  explicit CausalHeading(int window_frames) : CausalHeading(std::max(1, window_frames), 0) {}
  // For frames at any times: over those of the last `window` seconds, but no more than
  // `most_frames`.
  static CausalHeading over_seconds(double window, int most_frames) {
    return CausalHeading(most_frames, window);
  }

  // `left_thigh` minus `right_thigh`: from thigh to thigh in the world (any unit). `time`: of this
  // frame, in seconds, for a window in seconds; when it goes back, the average begins anew. Returns
  // the heading with this frame included.
  Scalar advance(const Vector3<Scalar>& right_to_left, double time = 0) noexcept {
    Vector3<Scalar> facing(-right_to_left.z(), Scalar(0), right_to_left.x());
    const Scalar length = facing.norm();
    if (length > Scalar(1e-9)) facing /= length;
    if (filled_ > 0 && time < last_time_) reset();
    last_time_ = time;
    frames_[next_] = {facing, time};
    next_ = (next_ + 1) % frames_.size();
    filled_ = std::min(filled_ + 1, frames_.size());
    // Summed afresh: a running sum would drift over hours and differ between learning and playing.
    Vector3<Scalar> sum = Vector3<Scalar>::Zero();
    for (std::size_t i = 0; i < filled_; ++i)
      if (window_ <= 0 || time - frames_[i].time <= window_ - rounding) sum += frames_[i].facing;
    return std::atan2(sum.x(), sum.z());
  }

  void reset() noexcept { next_ = filled_ = 0; }

 private:
  // A frame that is as old as the window but for this many seconds has left it.
  static constexpr double rounding = 0.002;
  struct Frame {
    Vector3<Scalar> facing = Vector3<Scalar>::Zero();
    double time = 0;
  };

  CausalHeading(int frames, double window) : window_(window), frames_(frames) {}

  double window_, last_time_ = 0;
  std::vector<Frame> frames_;
  std::size_t next_ = 0, filled_ = 0;
};

}  // namespace gait
