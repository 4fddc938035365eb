#include "gait/play/cycles/truncated_normal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gait {

namespace {

double density(double x) noexcept {
  return std::exp(-0.5 * x * x) / std::sqrt(2 * std::numbers::pi);
}

// For probabilities up to a half. Starts where the tail's leading term would put it and goes on
// with Halley's method on the logarithm of the distribution function, which is nearly a parabola.
double lower_quantile(double probability) noexcept {
  const double wanted = std::log(probability);
  double x = -std::sqrt(std::max(0.0, -2 * wanted - std::log(1 - 2 * wanted) - 0.6));
  for (int i = 0; i < 4; ++i) {
    const double mass = normal_distribution(x);
    const double slope = density(x) / mass;    // of the logarithm
    const double bend = -slope * (x + slope);  // and its derivative
    const double miss = std::log(mass) - wanted;
    x -= 2 * miss * slope / (2 * slope * slope - miss * bend);
  }
  return x;
}

}  // namespace

double normal_distribution(double x) noexcept { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

double normal_quantile(double probability) noexcept {
  const double p = std::clamp(probability, 1e-300, 1.0 - 1e-16);
  return p <= 0.5 ? lower_quantile(p) : -lower_quantile(1 - p);
}

double truncated_normal(double uniform, double lowest, double highest) noexcept {
  if (!(lowest < highest)) return 0.5 * (lowest + highest);
  if (lowest + highest > 0) return -truncated_normal(1 - uniform, -highest, -lowest);
  const double below = normal_distribution(lowest);
  const double mass = normal_distribution(highest) - below;
  return std::clamp(normal_quantile(below + uniform * mass), lowest, highest);
}

}  // namespace gait
