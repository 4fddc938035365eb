#include "gait/motion/body_frame.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "gait/error.h"
#include "gait/motion/captured/walk_doubts.h"
#include "gait/motion/contacts.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"

namespace gait {
namespace {

struct Measured {
  Eigen::Vector3d feet_to_head = Eigen::Vector3d::Zero();  // mean over frames, file's unit
  double feet_to_head_length = 0;                          // mean of the lengths
  double leg = 0;                                          // mean thigh + shank, file's unit
};

// The highest joint with a known name, to find the direction up.
int top_joint(const JointRoles& roles) {
  for (const Role role : {Role::head, Role::neck, Role::spine, Role::hips})
    if (const int joint = roles.joint(role); joint >= 0) return joint;
  return -1;
}

Measured measure(const Clip& clip, const JointRoles& roles) {
  Measured sum;
  const int top = top_joint(roles);
  if (!roles.has_legs() || clip.frames() == 0) return sum;
  const WorldPoses world = world_poses(clip);
  for (int frame = 0; frame < clip.frames(); ++frame) {
    const Eigen::Vector3d* at =
        world.positions.data() + static_cast<std::size_t>(frame) * clip.skeleton.joints.size();
    const Eigen::Vector3d body = at[top] - (at[roles.left.foot] + at[roles.right.foot]) / 2;
    sum.feet_to_head += body;
    sum.feet_to_head_length += body.norm();
    for (const Leg& leg : {roles.left, roles.right})
      sum.leg +=
          ((at[leg.thigh] - at[leg.shank]).norm() + (at[leg.shank] - at[leg.foot]).norm()) / 2;
  }
  sum.feet_to_head /= clip.frames();
  sum.feet_to_head_length /= clip.frames();
  sum.leg /= clip.frames();
  return sum;
}

// Turns the given axis (0, 1, 2; sign +1 or -1) onto +Y by the shortest way.
Eigen::Quaterniond onto_y(int axis, double sign) {
  if (axis == 1 && sign < 0)  // half a turn, for which no axis is the nearest: X
    return Eigen::Quaterniond(0, 1, 0, 0);
  return turn_between(sign * Eigen::Vector3d::Unit(axis), Eigen::Vector3d::UnitY());
}

std::string number_text(double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::general, 3);
  return {digits.data(), end.ptr};
}

// Below this agreement the frames' directions cancel out.
constexpr double least_agreement = 0.5;

void guess_up(const Clip& clip, const Eigen::Vector3d& feet_to_head, BodyFrame& frame) {
  if (feet_to_head.norm() > 0 && frame.up_agreement < least_agreement) {
    frame.warnings.push_back(clip.name +
                             ": which way is up is doubtful, as the body turns over and over; "
                             "taking Y (say --up x, y or z)");
    return;
  }
  if (feet_to_head.norm() == 0) {
    frame.warnings.push_back(clip.name +
                             ": cannot tell which way is up, as no head and feet are known; taking "
                             "Y (say --up x, y or z)");
    return;
  }
  int axis = 0;
  const double along = feet_to_head.cwiseAbs().maxCoeff(&axis);
  const double sign = feet_to_head[axis] < 0 ? -1 : 1;
  frame.to_y_up = onto_y(axis, sign);
  const std::string name = std::string(sign < 0 ? "-" : "") + "XYZ"[axis];
  // A walker leans a little. A body that lies or sits does not show which way is up.
  if (along < std::cos(30 * std::numbers::pi / 180) * feet_to_head.norm())
    frame.warnings.push_back(
        clip.name + ": which way is up is doubtful, as feet to head lean by " +
        number_text(std::acos(along / feet_to_head.norm()) * 180 / std::numbers::pi) +
        " degrees from " + name + "; taking it (say --up x, y or z)");
  else if (sign < 0)
    frame.warnings.push_back(clip.name + ": the body stands upside down along " + name +
                             "; taking that as up (say --up x, y or z)");
}

// The first pose's longest side, for skeletons without known legs.
double extent(const Clip& clip) {
  if (clip.frames() == 0) return 0;
  const WorldPoses world = world_poses(clip);
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY), high = -low;
  for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
    std::vector<Eigen::Vector3d> ends{world.positions[joint]};
    for (const Eigen::Vector3d& tip : clip.skeleton.joints[joint].tips)
      ends.push_back(world.positions[joint] + world.rotations[joint] * tip);
    for (const Eigen::Vector3d& end : ends) {
      low = low.cwiseMin(end);
      high = high.cwiseMax(end);
    }
  }
  return (high - low).maxCoeff();
}

// How the body walks, if it does.
std::optional<WalkTempo> tempo_of(const Clip& clip, const JointRoles& roles, double leg,
                                  const BodyFrame& frame) {
  BodyFrame scaled = frame;
  scaled.metres_per_unit = 1 / leg;
  const Clip in_legs = in_metres_y_up(clip, scaled);
  const WalkTrack track = follow_walk(in_legs, roles);
  if (steps_between(track.contacts).size() < 2 || !(track.speed > 0) ||
      !walk_doubts(in_legs, roles, track).empty())
    return std::nullopt;
  return WalkTempo{1 / track.cycle_seconds, track.speed};
}

void guess_unit(const Clip& clip, const JointRoles& roles, double leg, BodyFrame& frame) {
  UnitGuess guess;
  if (leg > 0)
    guess = unit_of_leg(leg, unit_is_open(leg) ? tempo_of(clip, roles, leg, frame) : std::nullopt);
  else if (const double height = extent(clip); height > 0)
    guess = unit_of_height(height);
  else
    guess.doubt =
        "cannot tell the unit, as the body has no size; taking cm (say --unit m, cm, mm, in, ft or "
        "metres per unit)";
  frame.metres_per_unit = guess.metres_per_unit;
  if (!guess.doubt.empty()) frame.warnings.push_back(clip.name + ": " + guess.doubt);
}

}  // namespace

BodyFrame guess_body_frame(const Clip& clip, const JointRoles& roles,
                           const BodyFrameOverride& said) {
  BodyFrame frame;
  const Measured measured = measure(clip, roles);
  if (measured.feet_to_head_length > 0)
    frame.up_agreement = measured.feet_to_head.norm() / measured.feet_to_head_length;
  if (said.up_axis) {
    const char axis = *said.up_axis;
    if (axis < 'x' || axis > 'z')
      throw Error(std::string("expected x, y or z as the axis that points up, found '") + axis +
                  "'");
    frame.to_y_up = onto_y(axis - 'x', 1);
  } else {
    guess_up(clip, measured.feet_to_head, frame);
  }
  if (!said.metres_per_unit)
    guess_unit(clip, roles, measured.leg, frame);
  else if (*said.metres_per_unit > 0)
    frame.metres_per_unit = *said.metres_per_unit;
  else
    throw Error("expected metres per unit above zero, found " + number_text(*said.metres_per_unit));
  return frame;
}

Clip in_metres_y_up(const Clip& clip, const BodyFrame& frame) {
  Clip result = clip;
  for (Joint& joint : result.skeleton.joints) {
    joint.offset *= frame.metres_per_unit;
    if (joint.parent < 0) joint.offset = frame.to_y_up * joint.offset;
    for (Eigen::Vector3d& tip : joint.tips) tip *= frame.metres_per_unit;
  }
  for (Eigen::Vector3d& translation : result.translations) translation *= frame.metres_per_unit;
  for (int joint = 0; joint < result.skeleton.size(); ++joint) {
    if (result.skeleton.joints[joint].parent >= 0) continue;
    for (int t = 0; t < result.frames(); ++t) {
      result.pose(t)[joint] = frame.to_y_up * result.pose(t)[joint];
      result.translation(t)[joint] = frame.to_y_up * result.translation(t)[joint];
    }
  }
  return result;
}

Eigen::Quaterniond root_rotation_in_file(const Eigen::Quaterniond& rotation,
                                         const BodyFrame& frame) {
  return frame.to_y_up.conjugate() * rotation;
}

Eigen::Vector3d root_translation_in_file(const Eigen::Vector3d& translation,
                                         const BodyFrame& frame) {
  return frame.to_y_up.conjugate() * translation / frame.metres_per_unit;
}

}  // namespace gait
