// Send times: estimates when the frames of a stream would have arrived if none had been held up, on
// the clock of arrivals. It uses the sender's own clock where that agrees with the arrivals, else
// counts frames at the sender's rate. A frame that is held up by a network arrives later than that,
// never earlier. Nothing allocates.
#pragma once

#include <array>

namespace gait::osc {

class SendTimes {
 public:
  // The estimate for the next frame. `arrived`: seconds. `sent`: by the sender's clock, in seconds
  // or thousandths of a second; not a number where it has none.
  double next(double arrived, double sent) noexcept;
  void reset() noexcept { *this = {}; }

 private:
  static constexpr int most = 512;  // frames that are remembered
  struct Frame {
    double arrived = 0, sent = 0, number = 0;
  };

  double by_clock() noexcept;
  double by_number() noexcept;
  bool clock_agrees() const noexcept;
  void find_period() noexcept;
  double slope_below(double most_late) const noexcept;
  double lateness(int back) const noexcept;
  bool some_were_lost(double& late) const noexcept;
  Frame& at(int back) noexcept {
    return frames_[static_cast<std::size_t>((latest_ - back + most) % most)];
  }
  const Frame& at(int back) const noexcept {
    return frames_[static_cast<std::size_t>((latest_ - back + most) % most)];
  }
  // The least of arrival minus x over the last frames, x being a frame's time on another clock.
  template <class Time>
  double least_delay(int frames, Time time) const noexcept;

  std::array<Frame, most> frames_{};
  int count_ = 0, latest_ = 0;
  int clocked_ = 0;                   // frames in a row with a clock that goes on
  double unit_ = 1;                   // of the sender's clock, seconds
  double period_ = 0;                 // seconds per frame; 0: not known yet
  int numbered_ = 0;                  // frames whose numbers are known
  int shifts_ = 0, since_shift_ = 0;  // several in a row: the period is wrong
};

}  // namespace gait::osc
