// The triangle of a leg: bend and distance lead back to each other, whatever the lengths.
#include "gait/motion/two_bone.h"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>

namespace gait {
namespace {

// Lays both bones into the plane, the lower one turned by the bend.
std::complex<double> end_of(const TwoBones& bones, double bend) {
  return bones.upper + std::polar(bones.lower, bend);
}

TEST(TwoBones, reaches_where_its_bones_end) {
  const TwoBones leg{0.43, 0.39};
  for (const double bend : {0.0, 0.2, 1.0, 2.5, std::numbers::pi}) {
    EXPECT_NEAR(leg.reach(bend), std::abs(end_of(leg, bend)), 1e-12);
    EXPECT_NEAR(leg.bend_at(leg.reach(bend)), bend, 1e-6);
    EXPECT_NEAR(leg.angle_off(bend), std::arg(end_of(leg, bend)), 1e-12);
  }
}

TEST(TwoBones, is_straight_where_it_is_too_short_and_folded_where_it_is_too_long) {
  const TwoBones leg{0.43, 0.39};
  EXPECT_EQ(leg.bend_at(1), 0);
  EXPECT_NEAR(leg.bend_at(0.01), std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace gait
