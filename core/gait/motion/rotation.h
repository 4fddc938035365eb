// Rotations of joints: unit quaternions and their exponential map (Grassia 1998), radians.
//
// Templated on the scalar: learning works in double, playing in float.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <span>

namespace gait {

template <typename Scalar>
using Quaternion = Eigen::Quaternion<Scalar>;
template <typename Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;

// The same rotation with w >= 0: the shorter way round.
template <typename Scalar>
Quaternion<Scalar> short_way(const Quaternion<Scalar>& rotation) noexcept {
  return rotation.w() < Scalar(0) ? Quaternion<Scalar>(-rotation.coeffs()) : rotation;
}

// Rotation vector (axis times angle, radians) to unit quaternion. Near zero sin(a/2)/a is replaced
// by its series, so the map is smooth through the identity.
template <typename Scalar>
Quaternion<Scalar> exponential_map(const Vector3<Scalar>& rotation_vector) noexcept {
  const Scalar squared = rotation_vector.squaredNorm();
  Scalar half_cosine, half_sine_over_angle;
  if (squared < Scalar(1e-6)) {
    half_cosine = Scalar(1) - squared / Scalar(8) + squared * squared / Scalar(384);
    half_sine_over_angle = Scalar(0.5) - squared / Scalar(48) + squared * squared / Scalar(3840);
  } else {
    const Scalar angle = std::sqrt(squared);
    half_cosine = std::cos(angle / Scalar(2));
    half_sine_over_angle = std::sin(angle / Scalar(2)) / angle;
  }
  const Vector3<Scalar> imaginary = half_sine_over_angle * rotation_vector;
  return Quaternion<Scalar>(half_cosine, imaginary.x(), imaginary.y(), imaginary.z());
}

// Unit quaternion to rotation vector (radians), of length at most pi: the logarithm with w >= 0.
template <typename Scalar>
Vector3<Scalar> rotation_vector(const Quaternion<Scalar>& rotation) noexcept {
  const Quaternion<Scalar> q = short_way(rotation);
  const Scalar sine = q.vec().norm();
  if (sine < Scalar(1e-4)) return q.vec() * (Scalar(2) + sine * sine / Scalar(3));
  return q.vec() * (Scalar(2) * std::atan2(sine, q.w()) / sine);
}

// Angle between two rotations (radians, 0 to pi): the geodesic distance.
template <typename Scalar>
Scalar angle_between(const Quaternion<Scalar>& a, const Quaternion<Scalar>& b) noexcept {
  const Quaternion<Scalar> difference = a.conjugate() * b;
  return Scalar(2) * std::atan2(difference.vec().norm(), std::abs(difference.w()));
}

// Spherical linear interpolation the shorter way round (Shoemake 1985); share 0 gives a, 1 gives b.
template <typename Scalar>
Quaternion<Scalar> slerp(const Quaternion<Scalar>& a, const Quaternion<Scalar>& b,
                         Scalar share) noexcept {
  return a.slerp(share, b);
}

template <typename Scalar>
struct SwingTwist {
  Quaternion<Scalar> swing;  // about an axis perpendicular to the twist's
  Quaternion<Scalar> twist;  // about the given axis
};

// Splits rotation = swing * twist, the twist about the unit vector `axis`. Where the swing is half
// a turn the twist is not determined: it is then the identity.
template <typename Scalar>
SwingTwist<Scalar> swing_twist(const Quaternion<Scalar>& rotation,
                               const Vector3<Scalar>& axis) noexcept {
  const Vector3<Scalar> along = axis * rotation.vec().dot(axis);
  Quaternion<Scalar> twist(rotation.w(), along.x(), along.y(), along.z());
  const Scalar norm = twist.norm();
  if (norm < Scalar(1e-6))
    twist.setIdentity();
  else
    twist.coeffs() /= norm;
  return {rotation * twist.conjugate(), twist};
}

// Chordal mean: the unit quaternion that maximises the sum of squared scalar products with all of
// `rotations`, the largest eigenvector of sum q q^T; w >= 0. The identity for an empty span.
Eigen::Quaterniond chordal_mean(std::span<const Eigen::Quaterniond> rotations);

// The shortest turn that brings the direction `from` to the direction `to`; about any axis across
// when they are opposite. Neither may be zero.
Eigen::Quaterniond turn_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) noexcept;

// Rotation about the vertical (Y) by `angle` radians: turns +Z towards +X.
template <typename Scalar>
Quaternion<Scalar> about_vertical(Scalar angle) noexcept {
  return Quaternion<Scalar>(std::cos(angle / Scalar(2)), Scalar(0), std::sin(angle / Scalar(2)),
                            Scalar(0));
}

}  // namespace gait
