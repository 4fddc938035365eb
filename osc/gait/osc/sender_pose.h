// Sender pose: the latest rotations and places of the sender's own joints in the world,
// right-handed, Y up, metres.
#pragma once

#include "gait/motion/humanoid.h"
#include "gait/osc/captured_frame.h"

namespace gait::osc {

class SenderPose {
 public:
  // Takes the rotations and places in a frame; all others keep their values. Returns false and
  // changes nothing for frames of named joints and of values.
  bool take(const CapturedFrame& frame) noexcept;
  void reset() noexcept { *this = {}; }

  // All bones that have ever arrived; `turns` holds their rotations in the world, as
  // SenderCalibration takes them.
  const HumanoidPose& world() const noexcept { return world_; }
  // The same bones relative to the nearest known bone above, for recordings of the sender's own
  // rig. Places that are all zero count as unknown.
  const HumanoidPose& local() const noexcept { return local_; }
  // Time of a bone's last arrival, seconds on the clock of arrivals.
  double seen(int bone) const noexcept { return seen_[static_cast<std::size_t>(bone)]; }
  // Whether the hips' place is known.
  bool placed() const noexcept { return world_.placed[index_of(Bone::hips)]; }
  // For senders of places alone: finds the directions of their X and Y anew from the next complete
  // frame, in which the performer faces the camera.
  void judge_axes_again() noexcept { axes_judged_ = false; }

 private:
  void take_local() noexcept;
  void take_world() noexcept;
  void take_places(const CapturedFrame& frame) noexcept;
  void judge_axes() noexcept;

  HumanoidPose world_, local_, told_;  // told_: as sent, made right-handed
  std::array<double, humanoid_bones> seen_{}, place_seen_{};
  Eigen::Vector3d root_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond root_rotation_ = Eigen::Quaterniond::Identity();
  bool axes_judged_ = false, places_known_ = false;
  bool in_world_ = false;  // rotations and places are in the world, not relative to the parent
  double x_sign_ = 1, y_sign_ = 1;
};

}  // namespace gait::osc
