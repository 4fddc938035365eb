// Body frame: conversion between a file's unit and axes and ours (metres, Y up).
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "gait/motion/clip.h"
#include "gait/motion/joint_roles.h"
#include "gait/motion/unit_guess.h"

namespace gait {

struct BodyFrame {
  double metres_per_unit = 1;
  Eigen::Quaterniond to_y_up = Eigen::Quaterniond::Identity();  // turns file axes into ours
  // How well frames agree on the direction from feet to head: the length of the mean vector divided
  // by the mean length; 1 when all frames have the same direction, 0 when nothing is known.
  double up_agreement = 0;
  std::vector<std::string> warnings;  // doubts about the guess; each names the flag that settles it
};

// Values the user sets, which replace the guess.
struct BodyFrameOverride {
  std::optional<double> metres_per_unit;
  std::optional<char> up_axis;  // 'x', 'y' or 'z'
};

// Guesses both. Up is the file's axis nearest to the direction from feet to head over all frames.
// The unit is the one in which the leg (thigh + shank by forward kinematics) is most likely a
// person's (unit_guess.h). Warns when the body leans by more than 30 degrees, when two units are
// plausible or none, or when the joints that this needs are not known. When frames agree by less
// than half (tumbling, noise), up is Y, with a warning.
BodyFrame guess_body_frame(const Clip& clip, const JointRoles& roles,
                           const BodyFrameOverride& said = {});

// Converts a clip to metres with Y up: rotates the roots and scales all lengths. Other joints keep
// their rotations, and their offsets keep the directions of the file.
Clip in_metres_y_up(const Clip& clip, const BodyFrame& frame);

// Convert the rotation and translation of a root in metres with Y up back to the file's frame.
Eigen::Quaterniond root_rotation_in_file(const Eigen::Quaterniond& rotation,
                                         const BodyFrame& frame);
Eigen::Vector3d root_translation_in_file(const Eigen::Vector3d& translation,
                                         const BodyFrame& frame);

}  // namespace gait
