// Whether all numbers of a frame are finite: what players check before they take one.
#pragma once

#include <Eigen/Geometry>
#include <span>

namespace gait {

// Several at a time: zero times a number that is not finite is none.
inline bool all_finite(std::span<const float> values) noexcept {
  const Eigen::Map<const Eigen::ArrayXf> numbers(values.data(), std::ssize(values));
  return (0.0f * numbers).sum() == 0.0f;
}

inline bool all_finite(std::span<const Eigen::Quaternionf> rotations) noexcept {
  return rotations.empty() || all_finite({rotations.front().coeffs().data(), 4 * rotations.size()});
}

}  // namespace gait
