// The 1-euro filter on rotations: a camera's tremble goes, quick movement is not late.
#include "gait/motion/one_euro_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gait/motion/rotation.h"

namespace gait::testing {
namespace {

constexpr double rate = 60;

Eigen::Quaterniond turned(double angle) { return exponential_map<double>({0, angle, 0}); }

// How far the filtered rotation is from the true one, root mean square, radians.
template <class Angle>
double error(Angle angle, double noise, double cutoff, double uneven = 0) {
  OneEuroFilter<double> filter(1);
  filter.set_cutoff(cutoff);
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> chance(-uneven, uneven);
  double squares = 0, before = 0;
  for (int i = 0; i < 600; ++i) {
    const double time = (i + chance(random)) / rate;
    Eigen::Quaterniond rotation =
        exponential_map<double>(noise *
                                Eigen::Vector3d(normal(random), normal(random), normal(random))) *
        turned(angle(time));
    filter.apply(std::span(&rotation, 1), time - before);
    before = time;
    EXPECT_NEAR(rotation.norm(), 1, 1e-9);
    if (i >= 60) squares += std::pow(angle_between(rotation, turned(angle(time))), 2);
  }
  return std::sqrt(squares / 540);
}

TEST(OneEuroFilter, takes_most_of_a_camera_s_tremble_away_at_rest) {
  const auto still = [](double) { return 0.4; };
  EXPECT_LT(error(still, 0.02, 1), 0.5 * error(still, 0.02, 0));
  EXPECT_LT(error(still, 0.02, 1, 0.3), 0.5 * error(still, 0.02, 0, 0.3));
}

// A plain low pass at 1 Hz is late by 1 / (2 pi) s: at 3 rad/s by half a radian.
TEST(OneEuroFilter, is_not_late_when_an_arm_swings) {
  const auto swing = [](double time) { return 1.2 * std::sin(2.5 * time); };
  EXPECT_LT(error(swing, 0, 1), 0.15);
  EXPECT_EQ(error(swing, 0, 0), 0);
}

TEST(OneEuroFilter, begins_anew_after_a_gap) {
  OneEuroFilter<double> filter(1);
  filter.set_cutoff(0.5);
  Eigen::Quaterniond rotation = turned(0);
  filter.apply(std::span(&rotation, 1), 0);
  rotation = turned(1);
  filter.apply(std::span(&rotation, 1), 5);
  EXPECT_LT(angle_between(rotation, turned(1)), 1e-9);
}

}  // namespace
}  // namespace gait::testing
