// Jitter buffer: delays frames that arrive unevenly such that they leave evenly. Without delay each
// leaves at once. When it is full it drops the oldest frame. Nothing allocates after construction.
#pragma once

#include <span>
#include <vector>

namespace gait::osc {

class JitterBuffer {
 public:
  static constexpr int most_frames = 256;  // a second at 240 a second

  // `values`: number of values in a frame.
  explicit JitterBuffer(int values);

  void set_delay(double seconds) noexcept { delay_ = seconds; }
  // `time`: of arrival, seconds.
  void push(double time, std::span<const float> values) noexcept;
  // The oldest frame if it is due, empty otherwise; valid until the next call.
  std::span<const float> pop(double now) noexcept;
  // When the frame that was popped last arrived.
  double arrival() const noexcept { return arrival_; }
  void reset() noexcept { count_ = 0, arrivals_ = 0; }  // of frames and of the sender's clock
  int waiting() const noexcept { return count_; }
  // Number of frames dropped because the buffer was full, since construction.
  int lost() const noexcept { return lost_; }

 private:
  int values_;
  double delay_ = 0;
  std::vector<float> frames_;
  double due_[most_frames] = {}, arrived_[most_frames] = {}, arrival_ = 0;
  int first_ = 0, count_ = 0, lost_ = 0;

  // Estimate of the sender's clock: a regression line of the latest arrivals over their frame
  // numbers; lost frames have numbers too.
  struct Line {
    double number = 0, time = 0, period = 0, scatter = 0;  // a point on it, its slope, seconds
    double at(double n) const noexcept { return time + period * (n - number); }
  };
  static constexpr int most_arrivals = 64;
  double number_after(double time) const noexcept;
  void fit_line() noexcept;
  Line line_;
  double numbers_[most_arrivals] = {}, times_[most_arrivals] = {};
  int arrivals_ = 0, latest_ = 0, holes_ = 0;
};

}  // namespace gait::osc
