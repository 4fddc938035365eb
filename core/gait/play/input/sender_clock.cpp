#include "gait/play/input/sender_clock.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

constexpr double lost_after = 0.8;  // periods; jitter stays below
constexpr double followed = 0.02;   // share of the rest per frame, and of a period at most

}  // namespace

void SenderClock::set_rate(double rate) noexcept {
  if (rate == rate_) return;
  rate_ = rate;
  started_ = false;
}

double SenderClock::time_of_arrival(double now) noexcept {
  if (!started_ || rate_ <= 0) {
    started_ = true;
    return time_ = arrived_ = now;
  }
  const double period = 1 / rate_;
  time_ += period;
  // What comes together with the frame before says nothing about time: a queue ran empty.
  if (now == arrived_) return time_;
  arrived_ = now;
  const double behind = now - time_;
  if (behind > lost_after * period) time_ += period * std::round(behind / period);
  const double most = followed * period;
  time_ += std::clamp(followed * (now - time_), -most, most);
  return time_;
}

}  // namespace gait
