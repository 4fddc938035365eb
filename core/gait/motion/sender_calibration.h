// Sender calibration: what a live sender's rig says, as turns since the T-pose, wherever its joints
// lie at rest and whichever way it faces.
//
// At one moment the performer stands in a calibration pose; from then on only what has changed in
// the world counts: D = F^-1 (W W0^-1) F S, with W0 the sender's rotations at that moment, F the
// way it faced, and S the turns from the T-pose to the calibration pose. Nothing allocates.
#pragma once

#include "gait/motion/humanoid.h"

namespace gait {

class SenderCalibration {
 public:
  // Without calibration the sender is taken at its word: a rig whose rest is the T-pose with every
  // joint along the world's axes, as the VMC protocol's usual avatars are.
  void reset() noexcept { *this = {}; }

  // `sender`: rotations in the world of its own joints, right-handed, as turns; places where they
  // are known. `standing`: turns of that calibration pose (HumanoidBody::calibration). False, with
  // nothing changed, when the hips' rotation is not known.
  bool set(const HumanoidPose& sender, const HumanoidPose& standing) noexcept;
  bool is_set() const noexcept { return set_; }

  // In place: from the sender's rotations to turns of the body. `yaw` (radians about the vertical):
  // without calibration the body is turned by it; with one it is added to the way the sender faced,
  // for rigs that tell no places and whose hips lie turned. Bones that were not seen at calibration
  // are not turned.
  void apply(HumanoidPose& pose, double yaw) const noexcept;

 private:
  bool set_ = false;
  std::bitset<humanoid_bones> seen_;
  std::array<Eigen::Quaterniond, humanoid_bones> before_, stand_;  // W0^-1, S
  Eigen::Quaterniond facing_ = Eigen::Quaterniond::Identity();
};

// Which way a body faces (radians about the vertical, 0 along +Z): across its thighs or upper arms
// where their places are known, else by the hips' rotation alone.
double facing_of(const HumanoidPose& pose) noexcept;

}  // namespace gait
