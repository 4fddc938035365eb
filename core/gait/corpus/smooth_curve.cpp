#include "gait/corpus/smooth_curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gait {

InterpolatingCurve::InterpolatingCurve(std::vector<double> knots, std::vector<double> values)
    : knots_(std::move(knots)), values_(std::move(values)), curvature_(knots_.size(), 0.0) {
  // Tridiagonal system for the second derivatives at the inner knots, solved by elimination.
  const std::size_t count = knots_.size();
  std::vector<double> upper(count, 0.0);
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double before = knots_[i] - knots_[i - 1], after = knots_[i + 1] - knots_[i];
    const double bend =
        6 * ((values_[i + 1] - values_[i]) / after - (values_[i] - values_[i - 1]) / before);
    const double pivot = 2 * (before + after) - before * upper[i - 1];
    upper[i] = after / pivot;
    curvature_[i] = (bend - before * curvature_[i - 1]) / pivot;
  }
  for (std::size_t i = count - 1; i-- > 1;) curvature_[i] -= upper[i] * curvature_[i + 1];
}

double InterpolatingCurve::at(double x) const {
  const std::size_t last = knots_.size() - 1;
  const auto above = std::upper_bound(knots_.begin(), knots_.end(), x);
  const auto i = std::clamp<std::size_t>(
                     static_cast<std::size_t>(std::distance(knots_.begin(), above)), 1, last) -
                 1;
  const double width = knots_[i + 1] - knots_[i];
  const double slope = (values_[i + 1] - values_[i]) / width;
  if (x < knots_.front())
    return values_.front() + (x - knots_.front()) * (slope - width * curvature_[1] / 6);
  if (x > knots_.back())
    return values_.back() + (x - knots_.back()) * (slope + width * curvature_[last - 1] / 6);
  const double b = (x - knots_[i]) / width, a = 1 - b;
  return a * values_[i] + b * values_[i + 1] +
         width * width / 6 *
             (a * (a * a - 1) * curvature_[i] + b * (b * b - 1) * curvature_[i + 1]);
}

ApproximatingCurve::ApproximatingCurve(double first, double spacing, std::vector<double> control)
    : first_(first), spacing_(spacing), control_(std::move(control)) {}

double ApproximatingCurve::at(double x) const {
  const int last = static_cast<int>(control_.size()) - 1;
  const double place = (x - first_) / spacing_;
  const int i = static_cast<int>(std::floor(place));
  const double t = place - i;
  const auto control = [&](int k) {
    return control_[static_cast<std::size_t>(std::clamp(k, 0, last))];
  };
  const double a = 1 - t;
  return (a * a * a * control(i - 1) + (4 - 6 * t * t + 3 * t * t * t) * control(i) +
          (4 - 6 * a * a + 3 * a * a * a) * control(i + 1) + t * t * t * control(i + 2)) /
         6;
}

double ShapedCurve::at(double x) const {
  x = std::clamp(x, knots_.front().x, knots_.back().x);
  std::size_t i = 0;
  while (i + 2 < knots_.size() && x > knots_[i + 1].x) ++i;
  const Knot &from = knots_[i], &to = knots_[i + 1];
  const double width = to.x - from.x, s = (x - from.x) / width, r = 1 - s;
  const auto slope_shape = [](double u) { return u * (1 + u * u * (-6 + u * (8 - 3 * u))); };
  return from.value + (to.value - from.value) * smoother_step(s) +
         width * (from.slope * slope_shape(s) - to.slope * slope_shape(r));
}

double smoother_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10 + x * (-15 + 6 * x));
}

}  // namespace gait
