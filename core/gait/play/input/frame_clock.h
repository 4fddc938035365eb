// The clock of a live stream: poses come at the sender's times, frames leave at the model's rate.
//
// Rotations are resampled by SLERP and plain values linearly between the two poses around a tick,
// so that 30, 60 and 120 fps versions of a walk give the same frames. There is no look-ahead: a
// tick is due as soon as a pose at or after it has come. Ticks count from the first pose.
//
// A pose that comes within 0.55 ms of a tick is that tick's frame, untouched, and pulls the clock a
// tenth of the difference its way. Thus a sender at the model's own rate passes one for one however
// its times are rounded (0.0333333 s, whole milliseconds, 29.97 fps), and never drifts away. Once a
// sender has been seen to keep the model's rate, a pose within three tenths of a period of a tick
// is that tick's: times of arrival tremble, and a pose that comes a little early must not wait for
// the next one. Times in seconds.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

namespace gait {

class FrameClock {
 public:
  enum class Arrival {
    accepted,
    restarted,  // the first pose, or time jumped by more than the longest gap: ticks count from
                // here
    rejected,   // not after the pose before, or a number that is not finite: nothing changed
  };

  // `frame_rate`: frames per second of the model. `rotations`, `plain`: entries per pose of either
  // kind. A jump of time by more than `longest_gap` seconds, either way, is not bridged. Throws
  // Error unless frame_rate and longest_gap are positive and the sizes not negative.
  FrameClock(double frame_rate, int rotations, int plain = 0, double longest_gap = 1.0);

  // Takes a pose with its time. Both spans have the sizes given at construction (one of another
  // size is rejected). Ticks of the pose before that were not pulled are lost.
  Arrival push(double time, std::span<const Eigen::Quaternionf> rotations,
               std::span<const float> plain = {}) noexcept;

  // Writes the next frame that is due into the spans (sizes as above) and says true; false when
  // none is due, with nothing written. After a push, pull until it says false.
  bool next(std::span<Eigen::Quaternionf> rotations, std::span<float> plain = {}) noexcept;

  // Of the frame pulled last: its time by the sender's clock, and whether it is the first after a
  // (re)start, so that no frame before it belongs to the same motion.
  double time() const noexcept { return frame_time_; }
  bool first_of_run() const noexcept { return first_of_run_; }

  // Forgets all poses: the next one starts the clock anew.
  void reset() noexcept;

 private:
  struct Pose {
    double time = 0;
    std::vector<Eigen::Quaternionf> rotations;
    std::vector<float> plain;
  };
  void keep(double time, std::span<const Eigen::Quaternionf> rotations,
            std::span<const float> plain) noexcept;

  void measure(double passed) noexcept;
  void begin_run() noexcept;
  double usual_tolerance() const noexcept;

  double period_, longest_gap_, tolerance_;
  // Between the latest poses: how long, and how many of the model's frames, as near as that may be.
  static constexpr int most_intervals = 32;
  struct Interval {
    double seconds = 0, frames = 0;
  };
  std::array<Interval, most_intervals> lately_;
  int intervals_ = 0;  // since the beginning of the run
  Pose before_, latest_;
  int poses_ = 0;         // how many of before_ and latest_ hold a pose of this run: 0, 1 or 2
  double tick_ = 0;       // time of the next frame
  bool started_ = false;  // whether the next frame is the first of its run
  double frame_time_ = 0;
  bool first_of_run_ = false;
};

}  // namespace gait
