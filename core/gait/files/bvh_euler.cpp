// Rotations into a BVH file's Euler angles.
//
// For an order i, j, i of axes, with e = +1 when (i, j, k) is right-handed and -1 otherwise, the
// quaternion of R_i(a) R_j(b) R_i(c) is
//   w = cos(b/2) cos((a+c)/2)     q_i = cos(b/2) sin((a+c)/2)
//   q_j = sin(b/2) cos((a-c)/2)   q_k = e sin(b/2) sin((a-c)/2)
// which gives b and the sum and difference of a and c by one arc tangent each, without a singular
// formula. An order i, j, k of three axes is brought to that form: R_j(90 deg) turns axis i onto
// -e k, so R_i(a) R_j(b) R_k(c) R_j(90 deg) = R_i(a) R_j(b + 90 deg) R_i(-e c).
#include <array>
#include <cmath>
#include <numbers>

#include "gait/error.h"
#include "gait/files/bvh.h"

namespace gait {
namespace {

using Angles = std::array<double, 3>;  // radians

constexpr double pi = std::numbers::pi;

// Below this the sine or cosine of b/2 leaves one of a+c and a-c to chance (gimbal lock). What is
// lost by ignoring it is at most 4e-7 rad: 2e-5 degrees, below what a file's digits hold.
constexpr double locked = 1e-7;

double to_half_turn(double angle) { return std::remainder(angle, 2 * pi); }
double nearest_turn(double angle, double wanted) { return wanted + to_half_turn(angle - wanted); }

struct Columns {
  std::array<Eigen::Index, 3> position{-1, -1, -1};  // by axis
  std::vector<Eigen::Index> rotation;                // in the channels' order
  std::vector<int> axes;                             // of those
};

Columns columns_of(const BvhFile& file, int joint) {
  Eigen::Index column = 0;
  for (int before = 0; before < joint; ++before)
    column += static_cast<Eigen::Index>(file.channels[before].size());
  Columns columns;
  for (const Channel channel : file.channels[joint]) {
    const int axis = static_cast<int>(channel) % 3;
    if (channel <= Channel::z_position) {
      columns.position[axis] = column;
    } else {
      columns.rotation.push_back(column);
      columns.axes.push_back(axis);
    }
    ++column;
  }
  return columns;
}

bool spans_all_rotations(const std::vector<int>& axes) {
  return axes.size() == 3 && axes[0] != axes[1] && axes[1] != axes[2];
}

double distance(const Angles& a, const Angles& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

// Angles a, b, c of order i, j, i nearest to `before`, of both solutions: a, b, c and a + 180 deg,
// -b, c + 180 deg. `k` is the third axis.
Angles nearest_proper_angles(const Eigen::Quaterniond& q, int i, int j, int k, double e,
                             const Angles& before) {
  const double cosine = std::hypot(q.w(), q.coeffs()[i]);
  const double sine = std::hypot(q.coeffs()[j], q.coeffs()[k]);
  const double b = 2 * std::atan2(sine, cosine);
  const double sum = 2 * std::atan2(q.coeffs()[i], q.w());
  const double difference = 2 * std::atan2(e * q.coeffs()[k], q.coeffs()[j]);
  Angles best{};
  double least = INFINITY;
  for (const bool other : {false, true}) {
    Angles angles;
    angles[1] = nearest_turn(other ? -b : b, before[1]);
    if (sine < locked) {  // only a + c is known: share its change
      const double change = to_half_turn(sum - before[0] - before[2]) / 2;
      angles[0] = before[0] + change;
      angles[2] = before[2] + change;
    } else if (cosine < locked) {  // only a - c is known
      const double change = to_half_turn(difference - before[0] + before[2]) / 2;
      angles[0] = before[0] + change;
      angles[2] = before[2] - change;
    } else {
      const double half_turn = other ? pi : 0;
      angles[0] = nearest_turn((sum + difference) / 2 + half_turn, before[0]);
      angles[2] = nearest_turn((sum - difference) / 2 + half_turn, before[2]);
    }
    const double far = distance(angles, before);
    if (far < least) {
      least = far;
      best = angles;
    }
  }
  return best;
}

Angles nearest_angles(const Eigen::Quaterniond& rotation, const std::vector<int>& axes,
                      const Angles& before) {
  const int i = axes[0], j = axes[1], k = 3 - i - j;
  const double e = (j - i + 3) % 3 == 1 ? 1 : -1;
  if (axes[2] == i) return nearest_proper_angles(rotation, i, j, k, e, before);
  Eigen::Quaterniond quarter(std::sqrt(0.5), 0, 0, 0);
  quarter.coeffs()[j] = std::sqrt(0.5);
  const Angles angles = nearest_proper_angles(rotation * quarter, i, j, k, e,
                                              {before[0], before[1] + pi / 2, -e * before[2]});
  return {angles[0], angles[1] - pi / 2, -e * angles[2]};
}

}  // namespace

bool takes_rotation(const BvhFile& file, int joint) {
  return spans_all_rotations(columns_of(file, joint).axes);
}

void set_rotation(BvhFile& file, int frame, int joint, const Eigen::Quaterniond& rotation) {
  const Columns columns = columns_of(file, joint);
  if (!spans_all_rotations(columns.axes))
    throw Error(file.name + ": joint '" + file.skeleton.joints[joint].name +
                "': expected three rotation channels that can take any rotation, found " +
                std::to_string(columns.axes.size()) +
                (columns.axes.size() == 3 ? " with an axis twice in a row" : ""));
  Angles before{};
  if (frame > 0)
    for (int n = 0; n < 3; ++n) before[n] = file.values(frame - 1, columns.rotation[n]) * pi / 180;
  const Angles angles = nearest_angles(rotation.normalized(), columns.axes, before);
  // A microdegree is finer than any reader asks for and keeps the text short; + 0 turns -0 to 0.
  for (int n = 0; n < 3; ++n)
    file.values(frame, columns.rotation[n]) = std::round(angles[n] * 180 / pi * 1e6) / 1e6 + 0.0;
}

void set_translation(BvhFile& file, int frame, int joint, const Eigen::Vector3d& translation) {
  const Columns columns = columns_of(file, joint);
  for (int axis = 0; axis < 3; ++axis)
    if (columns.position[axis] >= 0) file.values(frame, columns.position[axis]) = translation[axis];
}

}  // namespace gait
