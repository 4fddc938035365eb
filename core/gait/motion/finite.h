// Whether all numbers of a frame are finite: what players check before they take one.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

namespace gait {

inline bool all_finite(std::span<const float> values) noexcept {
  return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

inline bool all_finite(std::span<const Eigen::Quaternionf> rotations) noexcept {
  return std::ranges::all_of(rotations, [](const auto& q) { return q.coeffs().allFinite(); });
}

}  // namespace gait
