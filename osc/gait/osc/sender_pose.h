// Sender pose: what a frame told, as rotations and places in the world of the sender's own joints,
// right-handed, Y up, metres.
#pragma once

#include "gait/motion/humanoid.h"
#include "gait/osc/frame_gatherer.h"

namespace gait::osc {

class SenderPose {
 public:
  // Takes what the frame told in; what it did not tell is held as it was. Frames of named joints
  // and of values are not for this: false, nothing changed.
  bool take(const CapturedFrame& frame) noexcept;
  void reset() noexcept { *this = {}; }

  // Turns hold the rotations in the world (for a calibration to read). Bones that were ever told.
  const HumanoidPose& world() const noexcept { return world_; }
  // As they came: rotation relative to the nearest told bone above, place relative to it; for
  // recording the sender's own rig. Places that are all zero are not told.
  const HumanoidPose& local() const noexcept { return local_; }
  // When a bone was told last, seconds on the clock of arrivals.
  double seen(int bone) const noexcept { return seen_[static_cast<std::size_t>(bone)]; }
  // Whether the hips' place is known.
  bool placed() const noexcept { return world_.placed[index_of(Bone::hips)]; }
  // Places only: which way their X and Y go is judged anew with the next whole frame, in which the
  // performer faces the camera.
  void judge_axes_again() noexcept { axes_judged_ = false; }

 private:
  void take_local() noexcept;
  void take_world() noexcept;
  void take_places(const CapturedFrame& frame) noexcept;
  void judge_axes() noexcept;

  HumanoidPose world_, local_, told_;  // told_: in the sender's numbers, made right-handed
  std::array<double, humanoid_bones> seen_{}, place_seen_{};
  Eigen::Vector3d root_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond root_rotation_ = Eigen::Quaterniond::Identity();
  bool axes_judged_ = false, places_known_ = false;
  bool in_world_ = false;  // rotations and places are in the world, not relative to the parent
  double x_sign_ = 1, y_sign_ = 1;
};

}  // namespace gait::osc
