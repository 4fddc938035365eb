// Smooth curves through or near given values: what the synthetic walk is drawn with. All have
// continuous second derivatives, so that joints made from them move without jerks.
#pragma once

#include <vector>

namespace gait {

// The natural cubic spline through (knot, value) pairs; beyond its ends it goes on straight.
class InterpolatingCurve {
 public:
  InterpolatingCurve() = default;
  // `knots` ascending, at least two, as many as `values`.
  InterpolatingCurve(std::vector<double> knots, std::vector<double> values);

  double at(double x) const;

 private:
  std::vector<double> knots_, values_, curvature_;
};

// The uniform cubic B-spline: near its control values, never beyond them; holds the ends.
class ApproximatingCurve {
 public:
  ApproximatingCurve() = default;
  // Control value i belongs to x = first + i * spacing.
  ApproximatingCurve(double first, double spacing, std::vector<double> control);

  double at(double x) const;

 private:
  double first_ = 0, spacing_ = 1;
  std::vector<double> control_;
};

// Quintic Hermite pieces: passes each knot with the given slope and no curvature.
class ShapedCurve {
 public:
  struct Knot {
    double x, value, slope;
  };
  explicit ShapedCurve(std::vector<Knot> knots) : knots_(std::move(knots)) {}

  // `x` is held within the knots.
  double at(double x) const;

 private:
  std::vector<Knot> knots_;
};

// From 0 at x <= 0 to 1 at x >= 1, first and second derivatives zero at both ends.
double smoother_step(double x);

}  // namespace gait
