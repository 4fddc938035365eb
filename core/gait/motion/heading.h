// Heading: where a walk goes. An angle about the vertical (radians), 0 along +Z, growing towards
// +X.
//
// It is slow by definition: the direction of travel over one cycle, or the facing direction (normal
// to the line from thigh to thigh, averaged over a cycle) when the root hardly travels. The pelvis'
// own turning stays in the hips' rotation.
#pragma once

#include <vector>

#include "gait/motion/joint_roles.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"

namespace gait {

// Horizontal unit vector of a heading.
inline Eigen::Vector3d heading_direction(double heading) {
  return {std::sin(heading), 0, std::cos(heading)};
}

// Which way a body faces whose line from the right thigh (or shoulder) to the left is this.
inline double heading_across(const Eigen::Vector3d& right_to_left) {
  return std::atan2(-right_to_left.z(), right_to_left.x());
}

// Unwrapped heading per frame, from a centred window of one cycle; at the clip's ends the window is
// the first or last whole one. Needs hips and both thighs (JointRoles::has_legs).
std::vector<double> centred_heading(const WorldPoses& world, const JointRoles& roles, int joints,
                                    double frame_rate, double cycle_seconds);

// What a player can know: the facing direction averaged over the last cycle. Templated on the
// scalar so that learning and playing share it. Never allocates after construction.
template <typename Scalar>
class CausalHeading {
 public:
  // `window_frames`: frames in one cycle, at least 1.
  explicit CausalHeading(int window_frames)
      : window_(std::max(1, window_frames), Vector3<Scalar>::Zero()) {}

  // `left_thigh` minus `right_thigh`: from thigh to thigh in the world (any unit). Returns the
  // heading with this frame included.
  Scalar advance(const Vector3<Scalar>& right_to_left) noexcept {
    Vector3<Scalar> facing(-right_to_left.z(), Scalar(0), right_to_left.x());
    const Scalar length = facing.norm();
    if (length > Scalar(1e-9)) facing /= length;
    window_[next_] = facing;
    next_ = (next_ + 1) % static_cast<int>(window_.size());
    filled_ = std::min(filled_ + 1, static_cast<int>(window_.size()));
    // Summed afresh: a running sum would drift over hours and differ between learning and playing.
    Vector3<Scalar> sum = Vector3<Scalar>::Zero();
    for (int i = 0; i < filled_; ++i) sum += window_[i];
    return std::atan2(sum.x(), sum.z());
  }

  void reset() noexcept { next_ = filled_ = 0; }

 private:
  std::vector<Vector3<Scalar>> window_;
  int next_ = 0, filled_ = 0;
};

}  // namespace gait
