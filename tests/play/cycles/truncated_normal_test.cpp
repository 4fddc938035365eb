#include "gait/play/cycles/truncated_normal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <utility>

namespace gait {
namespace {

// Simpson's rule over the density.
double mass(double from, double to) {
  constexpr int pieces = 2000;
  double sum = 0;
  for (int i = 0; i <= pieces; ++i) {
    const double x = from + (to - from) * i / pieces;
    sum += (i == 0 || i == pieces ? 1 : i % 2 == 1 ? 4 : 2) * std::exp(-0.5 * x * x);
  }
  return sum * (to - from) / (3 * pieces) / std::sqrt(2 * 3.14159265358979323846);
}

TEST(TruncatedNormal, quantile_undoes_the_distribution_function) {
  for (double x = -36; x <= 5; x += 0.01) {
    // Above zero the distribution function itself has few digits left.
    const double tolerance = x < 0 ? 1e-12 : 1e-12 * std::exp(0.5 * x * x);
    EXPECT_NEAR(normal_quantile(normal_distribution(x)), x, std::max(1e-12, tolerance));
  }
}

TEST(TruncatedNormal, splits_the_mass_between_its_bounds_as_said) {
  for (const auto& [low, high] : std::initializer_list<std::pair<double, double>>{
           {-8, 8}, {-1, 2}, {0.3, 0.4}, {2, 5}, {-6, -3}, {1, 1.0001}})
    for (const double share : {0.001, 0.1, 0.5, 0.77, 0.999}) {
      const double x = truncated_normal(share, low, high);
      EXPECT_NEAR(mass(low, x) / mass(low, high), share, 1e-8) << low << ' ' << high;
    }
}

TEST(TruncatedNormal, never_leaves_its_bounds_however_far_out_they_are) {
  for (const auto& [low, high] : std::initializer_list<std::pair<double, double>>{
           {30, 31}, {-31, -30}, {8, 8.5}, {-100, 100}, {7.9999999, 8}})
    for (const double share : {0.0, 1e-16, 0.3, 1 - 1e-16, 1.0}) {
      const double x = truncated_normal(share, low, high);
      EXPECT_GE(x, low);
      EXPECT_LE(x, high);
    }
  EXPECT_EQ(truncated_normal(0.3, 2, 2), 2);
  EXPECT_EQ(truncated_normal(0.3, 3, 1), 2);
}

}  // namespace
}  // namespace gait
