// From a file's unit and axes to ours (metres, Y up) and back.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gait/motion/clip.h"
#include "gait/motion/joint_roles.h"

namespace gait {

struct BodyFrame {
  double metres_per_unit = 1;
  Eigen::Quaterniond to_y_up = Eigen::Quaterniond::Identity();  // turns file axes into ours
  // How well frames agree on the direction from feet to head: length of the mean over mean of the
  // lengths, 1 when all say the same, 0 when nothing is known.
  double up_agreement = 0;
  std::vector<std::string> warnings;  // when in doubt; each names the flag that settles it
};

// What the user says instead of the guess.
struct BodyFrameOverride {
  std::optional<double> metres_per_unit;
  std::optional<char> up_axis;  // 'x', 'y' or 'z'
};

// "m", "cm", "mm", "dm", "in", "ft", "cmu" (1/0.45 inch, in which CMU wrote its files) or a number:
// metres per unit. Throws Error for others.
double metres_per_unit_named(std::string_view unit);

// Guesses both: up is the axis from feet to head over all frames; the unit follows from the leg's
// length (thigh + shank by forward kinematics) being near a person's, 0.62 to 1.1 m. Warns where
// the body leans by more than 30 degrees, no unit fits, or the joints to tell by are not known.
// Where frames agree by less than half (tumbling, noise), up is Y, with a warning.
BodyFrame guess_body_frame(const Clip& clip, const JointRoles& roles,
                           const BodyFrameOverride& said = {});

// The clip in metres with Y up: roots are turned and everything is scaled. Other joints keep their
// rotations, and their offsets keep the directions of the file.
Clip in_metres_y_up(const Clip& clip, const BodyFrame& frame);

// The root rotation and translation of a clip in metres, back in the file's frame.
Eigen::Quaterniond root_rotation_in_file(const Eigen::Quaterniond& rotation,
                                         const BodyFrame& frame);
Eigen::Vector3d root_translation_in_file(const Eigen::Vector3d& translation,
                                         const BodyFrame& frame);

}  // namespace gait
