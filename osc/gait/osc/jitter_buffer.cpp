#include "gait/osc/jitter_buffer.h"

#include <algorithm>

namespace gait::osc {

JitterBuffer::JitterBuffer(int values)
    : values_(values), frames_(static_cast<std::size_t>(values) * most_frames) {}

void JitterBuffer::push(double time, std::span<const float> values, double sent) noexcept {
  if (delay_ <= 0) times_.reset();
  const double undelayed = delay_ > 0 ? times_.next(time, sent) : time;
  if (count_ == most_frames) {
    first_ = (first_ + 1) % most_frames;
    --count_;
    ++lost_;
  }
  const int at = (first_ + count_) % most_frames;
  const auto size = std::min(values.size(), static_cast<std::size_t>(values_));
  std::copy_n(values.begin(), size, frames_.begin() + static_cast<std::ptrdiff_t>(at) * values_);
  due_[at] = undelayed + delay_;
  arrived_[at] = time;
  ++count_;
}

std::span<const float> JitterBuffer::pop(double now) noexcept {
  if (count_ == 0 || (delay_ > 0 && due_[first_] > now)) return {};
  const std::span<const float> frame(frames_.data() + static_cast<std::ptrdiff_t>(first_) * values_,
                                     static_cast<std::size_t>(values_));
  arrival_ = arrived_[first_];
  first_ = (first_ + 1) % most_frames;
  --count_;
  return frame;
}

}  // namespace gait::osc
