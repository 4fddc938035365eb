#include "gait/play/body/one_euro_filter.h"

#include <algorithm>
#include <numbers>

#include "gait/motion/rotation.h"

namespace gait {

namespace {

constexpr float cutoff_of_speed = 1;  // Hz, as in the paper

}  // namespace

OneEuroFilter::OneEuroFilter(int rotations, double frame_rate)
    : period_(static_cast<float>(1 / frame_rate)),
      last_(static_cast<std::size_t>(rotations), Eigen::Quaternionf::Identity()),
      shown_(last_),
      speeds_(last_.size(), 0.0f) {}

void OneEuroFilter::set_cutoff(float hertz, float rise) noexcept {
  cutoff_ = hertz > 0 ? hertz : 0;
  rise_ = std::max(0.0f, rise);
  if (!on()) started_ = false;
}

// Of the way to the new value in one frame (the paper's alpha).
float OneEuroFilter::share(float cutoff) const noexcept {
  const float turns = 2 * std::numbers::pi_v<float> * cutoff * period_;
  return turns / (turns + 1);
}

void OneEuroFilter::apply(std::span<Eigen::Quaternionf> rotations) noexcept {
  if (!on() || rotations.size() != shown_.size()) return;
  if (!started_) {
    std::ranges::copy(rotations, last_.begin());
    shown_ = last_;
    std::ranges::fill(speeds_, 0.0f);
    started_ = true;
    return;
  }
  const float of_speed = share(cutoff_of_speed);
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const float speed = angle_between<float>(last_[i], rotations[i]) / period_;
    last_[i] = rotations[i];
    speeds_[i] += of_speed * (speed - speeds_[i]);
    shown_[i] = slerp<float>(shown_[i], rotations[i], share(cutoff_ + rise_ * speeds_[i]));
    rotations[i] = shown_[i];
  }
}

}  // namespace gait
