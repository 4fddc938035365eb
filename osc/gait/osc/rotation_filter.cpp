#include "gait/osc/rotation_filter.h"

#include <numbers>

#include "gait/motion/rotation.h"

namespace gait::osc {

namespace {

constexpr double speed_cutoff = 1;  // Hz, the paper's
constexpr double longest_gap = 1;   // seconds

// Equation 1 of the paper: how much of a new value is let through.
double share(double cutoff, double period) {
  const double tau = 1 / (2 * std::numbers::pi * cutoff);
  return 1 / (1 + tau / period);
}

}  // namespace

RotationFilter::RotationFilter(int rotations)
    : last_(static_cast<std::size_t>(rotations), Eigen::Quaterniond::Identity()),
      shown_(last_),
      speeds_(static_cast<std::size_t>(rotations), 0) {}

void RotationFilter::set_cutoff(double hertz, double rise) noexcept {
  if (cutoff_ <= 0) started_ = false;
  cutoff_ = hertz;
  rise_ = rise;
}

void RotationFilter::apply(double time, std::span<Eigen::Quaterniond> rotations) noexcept {
  if (cutoff_ <= 0) return;
  const double period = time - time_;
  time_ = time;
  const bool begin = !started_ || !(period > 1e-6) || period > longest_gap;
  started_ = true;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    if (begin) {
      shown_[i] = rotations[i];
      speeds_[i] = 0;
    } else {
      const double speed = angle_between(last_[i], rotations[i]) / period;
      speeds_[i] += share(speed_cutoff, period) * (speed - speeds_[i]);
      shown_[i] = slerp(shown_[i], rotations[i], share(cutoff_ + rise_ * speeds_[i], period));
    }
    last_[i] = rotations[i];
    rotations[i] = shown_[i];
  }
}

}  // namespace gait::osc
