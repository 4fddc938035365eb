#include "gait/osc/jitter_buffer.h"

#include <algorithm>
#include <cmath>

namespace gait::osc {

namespace {

// A second-order loop: how much of an arrival's lateness the even clock and its period take in.
constexpr double place_gain = 0.08, period_gain = 0.004;
constexpr double longest_gap = 0.5;  // seconds; after it the clock begins anew

}  // namespace

JitterBuffer::JitterBuffer(int values)
    : values_(values), frames_(static_cast<std::size_t>(values) * most_frames) {}

void JitterBuffer::push(double time, std::span<const float> values) noexcept {
  const double gap = time - last_;
  if (arrivals_ == 0 || gap > longest_gap || gap < 0) {
    arrivals_ = 1;
    even_ = time;
    period_ = 0;
  } else if (arrivals_ < 9) {  // the mean of the first gaps
    period_ += (gap - period_) / arrivals_;
    ++arrivals_;
    even_ = even_ + period_ + (time - even_ - period_) / arrivals_;
  } else {
    const double late = time - (even_ + period_);
    // Frames that were lost leave a hole of whole periods.
    const double lost = period_ > 0 ? std::floor(late / period_ + 0.25) : 0;
    const double rest = late - std::max(0.0, lost) * period_;
    even_ += period_ * (1 + std::max(0.0, lost)) + place_gain * rest;
    period_ += period_gain * rest;
  }
  last_ = time;
  if (count_ == most_frames) {
    first_ = (first_ + 1) % most_frames;
    --count_;
  }
  const int at = (first_ + count_) % most_frames;
  const auto size = std::min(values.size(), static_cast<std::size_t>(values_));
  std::copy_n(values.begin(), size, frames_.begin() + static_cast<std::ptrdiff_t>(at) * values_);
  due_[at] = delay_ > 0 ? even_ + delay_ : time;
  ++count_;
}

std::span<const float> JitterBuffer::pop(double now) noexcept {
  if (count_ == 0 || (delay_ > 0 && due_[first_] > now)) return {};
  const std::span<const float> frame(frames_.data() + static_cast<std::ptrdiff_t>(first_) * values_,
                                     static_cast<std::size_t>(values_));
  first_ = (first_ + 1) % most_frames;
  --count_;
  return frame;
}

}  // namespace gait::osc
