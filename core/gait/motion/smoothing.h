// Shapes and gains of gradual changes.
#pragma once

#include <algorithm>
#include <cmath>

namespace gait {

// Hermite's cubic step: 0 for x <= 0, 1 for x >= 1, without slope at both ends.
template <typename Scalar>
Scalar smoothstep(Scalar x) noexcept {
  x = std::clamp(x, Scalar(0), Scalar(1));
  return x * x * (3 - 2 * x);
}

// The same step from x = `from` to x = `until`; `from` must not equal `until`.
template <typename Scalar>
Scalar smoothstep(Scalar from, Scalar until, Scalar x) noexcept {
  return smoothstep((x - from) / (until - from));
}

// Gain of a first-order low pass: the share of the way to its input that it covers in `period`,
// 1 - exp(-period / time_constant). Both in seconds.
template <typename Scalar>
float first_order_gain(Scalar period, Scalar time_constant) noexcept {
  return static_cast<float>(1 - std::exp(-period / time_constant));
}

}  // namespace gait
