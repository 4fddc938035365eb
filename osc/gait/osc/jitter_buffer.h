// Jitter buffer: delays frames that arrive unevenly such that they leave evenly. A frame leaves the
// delay after the moment at which it would have arrived if nothing had held it up (SendTimes), so
// all that is late by less than the delay leaves evenly. Without delay each leaves at once. When it
// is full it drops the oldest frame. Nothing allocates after construction.
#pragma once

#include <span>
#include <vector>

#include "gait/osc/mocap_event.h"
#include "gait/osc/send_times.h"

namespace gait::osc {

class JitterBuffer {
 public:
  static constexpr int most_frames = 256;  // a second at 240 a second

  // `values`: number of values in a frame.
  explicit JitterBuffer(int values);

  void set_delay(double seconds) noexcept { delay_ = seconds; }
  // `time`: of arrival, seconds. `sent`: by the sender's clock, as SendTimes takes it.
  void push(double time, std::span<const float> values, double sent = not_sent) noexcept;
  // The oldest frame if it is due, empty otherwise; valid until the next call.
  std::span<const float> pop(double now) noexcept;
  // When the frame that was popped last arrived.
  double arrival() const noexcept { return arrival_; }
  void reset() noexcept { count_ = 0, times_.reset(); }  // of frames and of the sender's clock
  int waiting() const noexcept { return count_; }
  // Number of frames dropped because the buffer was full, since construction.
  int lost() const noexcept { return lost_; }

 private:
  int values_;
  double delay_ = 0;
  std::vector<float> frames_;
  double due_[most_frames] = {}, arrived_[most_frames] = {}, arrival_ = 0;
  int first_ = 0, count_ = 0, lost_ = 0;
  SendTimes times_;
};

}  // namespace gait::osc
