// Sender calibration: conversion of a live sender's rotations to turns since the T-pose, for any
// rest pose of its rig and any direction that it faces.
//
// At one moment the performer stands in a calibration pose. From then on the turn of a bone is
// D = F^-1 (W W0^-1) F S, with W its rotation in the world, W0 that rotation at the moment of
// calibration, F the direction the performer faced then, and S the turn from the T-pose to the
// calibration pose. Nothing allocates.
#pragma once

#include "gait/motion/humanoid.h"

namespace gait {

class SenderCalibration {
 public:
  // Without calibration, rotations count as turns: this fits a rig whose rest pose is the T-pose
  // with every joint along the world's axes, as the usual avatars of the VMC protocol have it.
  void reset() noexcept { *this = {}; }

  // `sender`: rotations of the sender's joints in the world, right-handed, in `turns`, and places
  // where known. `standing`: turns of the calibration pose (HumanoidBody::calibration). Returns
  // false and changes nothing when the hips' rotation is not known.
  bool set(const HumanoidPose& sender, const HumanoidPose& standing) noexcept;
  bool is_set() const noexcept { return set_; }

  // Converts the sender's rotations to turns of the body, in place. `yaw` (radians about the
  // vertical): without calibration the body is rotated by it; with calibration it is added to the
  // direction that the sender faced, for rigs without places whose hips are rotated at rest. Bones
  // that were not known at calibration get no turn.
  void apply(HumanoidPose& pose, double yaw) const noexcept;

 private:
  bool set_ = false;
  std::bitset<humanoid_bones> seen_;
  std::array<Eigen::Quaterniond, humanoid_bones> before_, stand_;  // W0^-1, S
  Eigen::Quaterniond facing_ = Eigen::Quaterniond::Identity();
};

// Direction that a body faces (radians about the vertical, 0 along +Z): from the places of its
// thighs or upper arms where these are known, else from the hips' rotation.
double facing_of(const HumanoidPose& pose) noexcept;

}  // namespace gait
