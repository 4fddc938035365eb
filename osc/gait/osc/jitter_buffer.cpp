#include "gait/osc/jitter_buffer.h"

#include <algorithm>
#include <cmath>

namespace gait::osc {

namespace {

// A frame was lost when the next one is later than most of a period, and later than it ever is.
constexpr double hole = 0.65;      // of a period
constexpr double scattered = 2.5;  // times the arrivals' standard deviation
constexpr int arrivals_to_know = 8;
constexpr int most_holes = 4;        // one after another
constexpr double longest_gap = 0.5;  // seconds; after it the clock begins anew

}  // namespace

JitterBuffer::JitterBuffer(int values)
    : values_(values), frames_(static_cast<std::size_t>(values) * most_frames) {}

double JitterBuffer::number_after(double time) const noexcept {
  const double next = numbers_[latest_] + 1;
  if (arrivals_ < arrivals_to_know || line_.period <= 0) return next;
  const double late = time - line_.at(next);
  if (std::abs(late) < std::max(hole * line_.period, scattered * line_.scatter)) return next;
  // A frame that was counted as lost but was only late gives its number back.
  return next + std::max(-1.0, std::round(late / line_.period));
}

// Least squares.
void JitterBuffer::fit_line() noexcept {
  double number = 0, time = 0, squares = 0, products = 0, errors = 0;
  for (int i = 0; i < arrivals_; ++i) {
    number += (numbers_[i] - number) / (i + 1);
    time += (times_[i] - time) / (i + 1);
  }
  for (int i = 0; i < arrivals_; ++i) {
    squares += (numbers_[i] - number) * (numbers_[i] - number);
    products += (numbers_[i] - number) * (times_[i] - time);
  }
  line_ = {number, time, squares > 0 ? products / squares : 0, 0};
  for (int i = 0; i < arrivals_; ++i) {
    const double error = times_[i] - line_.at(numbers_[i]);
    errors += error * error;
  }
  line_.scatter = std::sqrt(errors / arrivals_);
}

void JitterBuffer::push(double time, std::span<const float> values) noexcept {
  const double gap = arrivals_ == 0 ? 0 : time - times_[latest_];
  if (gap > longest_gap || gap < 0) arrivals_ = 0;
  double number = arrivals_ == 0 ? 0 : number_after(time);
  // Many holes in a row: the line is wrong, fitted to a burst, or the sender's rate changed.
  holes_ = arrivals_ > 0 && number > numbers_[latest_] + 1 ? holes_ + 1 : 0;
  if (holes_ == most_holes) {
    number = 0;
    arrivals_ = holes_ = 0;
  }
  latest_ = arrivals_ == 0 ? 0 : (latest_ + 1) % most_arrivals;
  arrivals_ = std::min(arrivals_ + 1, most_arrivals);
  numbers_[latest_] = number;
  times_[latest_] = time;
  fit_line();
  if (count_ == most_frames) {
    first_ = (first_ + 1) % most_frames;
    --count_;
    ++lost_;
  }
  const int at = (first_ + count_) % most_frames;
  const auto size = std::min(values.size(), static_cast<std::size_t>(values_));
  std::copy_n(values.begin(), size, frames_.begin() + static_cast<std::ptrdiff_t>(at) * values_);
  due_[at] = delay_ > 0 ? line_.at(number) + delay_ : time;
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
