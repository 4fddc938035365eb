// A critically damped smoother: a control on its way to where it was set, by two equal first-order
// lags in series. Neither the value nor its speed ever jumps, and no value between start and target
// is overshot.
#pragma once

#include <cmath>

namespace gait {

class Glide {
 public:
  explicit Glide(float value = 0) noexcept : target_(value), middle_(value), value_(value) {}

  void set(float target) noexcept { target_ = target; }
  void arrive() noexcept { middle_ = value_ = target_; }
  // `share`: of the way to go in this frame, 0..1; see glide_share.
  void advance(float share) noexcept {
    middle_ += share * (target_ - middle_);
    value_ += share * (middle_ - value_);
    constexpr float near = 1e-6f;  // further down only denormal numbers wait
    if (std::abs(target_ - middle_) < near && std::abs(target_ - value_) < near) arrive();
  }

  bool arrived() const noexcept { return value_ == target_ && middle_ == target_; }
  float value() const noexcept { return value_; }
  float target() const noexcept { return target_; }

 private:
  float target_, middle_, value_;
};

// The share with which a glide has done 98 % of its way once `passed` has added up to `whole`.
inline float glide_share(float passed, float whole) noexcept {
  return -std::expm1(-6 * passed / whole);
}

}  // namespace gait
