// Jitter buffer: frames that came unevenly leave evenly, later by a chosen time. Without delay each
// leaves at once. Bounded: when it is full the oldest goes. Nothing allocates after construction.
#pragma once

#include <span>
#include <vector>

namespace gait::osc {

class JitterBuffer {
 public:
  static constexpr int most_frames = 64;

  // `values` in a frame.
  explicit JitterBuffer(int values);

  void set_delay(double seconds) noexcept { delay_ = seconds; }
  // `time`: of arrival, seconds.
  void push(double time, std::span<const float> values) noexcept;
  // The oldest frame if it is due, empty otherwise; valid until the next call.
  std::span<const float> pop(double now) noexcept;
  void reset() noexcept { count_ = 0, arrivals_ = 0; }
  int waiting() const noexcept { return count_; }

 private:
  int values_;
  double delay_ = 0;
  std::vector<float> frames_;
  double due_[most_frames] = {};
  int first_ = 0, count_ = 0, arrivals_ = 0;
  double even_ = 0, period_ = 0, last_ = 0;  // the sender's clock as it is seen through jitter
};

}  // namespace gait::osc
