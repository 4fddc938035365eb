// Sender's clock: when was a frame taken that arrives now? Arrival is late and early by turns and
// some frames never come; a sender's rate, where it is known, gives times without that jitter.
//
// Frame follows frame by one period; when arrivals fall behind that by most of a period, a frame
// was lost and is counted. What remains of the difference is followed slowly, so a rate that is a
// little wrong does no harm. Times in seconds.
#pragma once

namespace gait {

class SenderClock {
 public:
  // Frames per second, above 0; 0: not known, frames are of when they arrive.
  void set_rate(double rate) noexcept;
  double rate() const noexcept { return rate_; }

  // The time of the frame that arrives at `now`, after the last one's.
  double time_of_arrival(double now) noexcept;
  // Forgets the stream: the next frame is the first.
  void reset() noexcept { started_ = false; }

 private:
  double rate_ = 0;
  bool started_ = false;
  double time_ = 0, arrived_ = 0;  // of the last frame: taken, arrived
};

}  // namespace gait
