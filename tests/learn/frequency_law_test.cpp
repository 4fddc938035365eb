#include "gait/learn/frequency_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "gait/error.h"

namespace gait {
namespace {

std::vector<CadencePoint> points_on(double scale, double power, double spread = 0) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise;
  std::vector<CadencePoint> points;
  for (double v = 0.9; v < 2.3; v += 0.05)
    points.push_back({v, scale * std::pow(v, power) * std::exp(spread * noise(random))});
  return points;
}

double misfit(const std::vector<CadencePoint>& points, double scale, double power) {
  double sum = 0;
  for (const CadencePoint& point : points)
    sum += std::pow(std::log(point.frequency / (scale * std::pow(point.speed_per_leg, power))), 2);
  return sum;
}

TEST(FrequencyLaw, points_on_a_law_give_that_law) {
  const FrequencyLaw law = fit_frequency_law(points_on(0.85, 0.4));  // G04 eq. 6
  EXPECT_NEAR(law.scale, 0.85, 1e-12);
  EXPECT_NEAR(law.power, 0.4, 1e-12);
}

TEST(FrequencyLaw, no_law_nearby_fits_scattered_points_better) {
  const auto points = points_on(0.75, 0.41, 0.05);
  const FrequencyLaw law = fit_frequency_law(points);
  const double least = misfit(points, law.scale, law.power);
  for (const double scale : {0.999, 1.0, 1.001})
    for (const double power : {-0.001, 0.0, 0.001}) {
      if (scale == 1.0 && power == 0.0) continue;
      EXPECT_GT(misfit(points, law.scale * scale, law.power + power), least);
    }
}

TEST(FrequencyLaw, walks_at_one_speed_take_the_power_known_before) {
  const std::vector<CadencePoint> points{{1.5, 0.95}, {1.5, 0.97}};
  EXPECT_THROW(fit_frequency_law(points), Error);
  const FrequencyLaw law = fit_frequency_law(points, LawBefore{{0.75, 0.41}, 0.3});
  EXPECT_NEAR(law.power, 0.41, 1e-12);
  EXPECT_NEAR(law.at(1.5), std::sqrt(0.95 * 0.97), 1e-12);
}

TEST(FrequencyLaw, many_walks_outweigh_what_was_known_before) {
  std::vector<CadencePoint> points;
  for (int i = 0; i < 100; ++i)
    for (const CadencePoint& point : points_on(0.7, 0.6)) points.push_back(point);
  EXPECT_NEAR(fit_frequency_law(points, LawBefore{{0.75, 0.41}, 0.3}).power, 0.6, 1e-3);
}

TEST(FrequencyLaw, nobody_steps_while_standing) { EXPECT_EQ(FrequencyLaw{}.at(0), 0); }

TEST(FrequencyLaw, points_that_are_none_are_refused) {
  EXPECT_THROW(fit_frequency_law({}), Error);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(fit_frequency_law(std::vector<CadencePoint>{{bad, 1}, {1, 1}}), Error) << bad;
    EXPECT_THROW(fit_frequency_law(std::vector<CadencePoint>{{1, bad}, {2, 1}}), Error) << bad;
  }
}

}  // namespace
}  // namespace gait
