#include "gait/play/input/frame_clock.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "gait/error.h"
#include "gait/motion/finite.h"
#include "gait/motion/rotation.h"

namespace gait {
namespace {

constexpr double snap_seconds =
    0.55e-3;                  // half a millisecond, what whole-millisecond times miss by
constexpr double pull = 0.1;  // share of the difference by which a pose moves the clock
// A sender keeps the model's rate when its mean interval is so near the period, and has left it
// when it is so far from it; shares of the period.
constexpr double same_rate = 0.02, other_rate = 0.05;
constexpr double same_rate_tolerance = 0.3;  // of a period
constexpr int intervals_to_know = 8;

}  // namespace

FrameClock::FrameClock(double frame_rate, int rotations, int plain, double longest_gap)
    : period_(1 / frame_rate), longest_gap_(longest_gap) {
  if (!std::isfinite(frame_rate) || frame_rate <= 0)
    throw Error("frame clock: expected a positive frame rate, found " + std::to_string(frame_rate));
  if (!std::isfinite(longest_gap) || longest_gap <= 0)
    throw Error("frame clock: expected a positive longest gap, found " +
                std::to_string(longest_gap) + " s");
  if (rotations < 0 || plain < 0)
    throw Error("frame clock: expected entry counts of zero or more, found " +
                std::to_string(rotations) + " rotations and " + std::to_string(plain) + " values");
  tolerance_ = usual_tolerance();
  for (Pose* pose : {&before_, &latest_}) {
    pose->rotations.assign(rotations, Eigen::Quaternionf::Identity());
    pose->plain.assign(plain, 0.0f);
  }
}

double FrameClock::usual_tolerance() const noexcept {
  return std::min(snap_seconds, 0.1 * period_);
}

FrameClock::Arrival FrameClock::push(double time, std::span<const Eigen::Quaternionf> rotations,
                                     std::span<const float> plain) noexcept {
  if (!std::isfinite(time) || rotations.size() != latest_.rotations.size() ||
      plain.size() != latest_.plain.size() || !all_finite(rotations) || !all_finite(plain))
    return Arrival::rejected;

  const double passed = time - latest_.time;
  if (poses_ == 0 || std::abs(passed) > longest_gap_) {
    begin_run();
    keep(time, rotations, plain);
    tick_ = time;
    started_ = true;
    return Arrival::restarted;
  }
  if (passed <= 0) return Arrival::rejected;

  // What was due and not pulled is lost.
  if (const double late = latest_.time + tolerance_ - tick_; late >= 0)
    tick_ += period_ * (std::floor(late / period_) + 1);
  measure(passed);
  keep(time, rotations, plain);
  return Arrival::accepted;
}

// A frame that was lost makes an interval of two: it says nothing of the rate. A burst is over when
// the latest poses no longer hold it.
void FrameClock::measure(double passed) noexcept {
  lately_[static_cast<std::size_t>(intervals_++ % most_intervals)] = {
      passed, std::max(1.0, std::round(passed / period_))};
  if (intervals_ < intervals_to_know) return;
  Interval sum;
  for (int i = 0; i < std::min(intervals_, most_intervals); ++i) {
    sum.seconds += lately_[static_cast<std::size_t>(i)].seconds;
    sum.frames += lately_[static_cast<std::size_t>(i)].frames;
  }
  const double off = std::abs(sum.seconds / sum.frames / period_ - 1);
  if (off < same_rate)
    tolerance_ = std::max(usual_tolerance(), same_rate_tolerance * period_);
  else if (off > other_rate)
    tolerance_ = usual_tolerance();
}

void FrameClock::keep(double time, std::span<const Eigen::Quaternionf> rotations,
                      std::span<const float> plain) noexcept {
  std::swap(before_, latest_);
  latest_.time = time;
  std::ranges::copy(rotations, latest_.rotations.begin());
  std::ranges::copy(plain, latest_.plain.begin());
  poses_ = std::min(poses_ + 1, 2);
}

bool FrameClock::next(std::span<Eigen::Quaternionf> rotations, std::span<float> plain) noexcept {
  if (poses_ == 0 || rotations.size() != latest_.rotations.size() ||
      plain.size() != latest_.plain.size() || tick_ > latest_.time + tolerance_)
    return false;

  frame_time_ = tick_;
  first_of_run_ = std::exchange(started_, false);
  const double late = latest_.time - tick_;
  if (poses_ == 1 || late <= tolerance_) {
    std::ranges::copy(latest_.rotations, rotations.begin());
    std::ranges::copy(latest_.plain, plain.begin());
    tick_ += period_ + pull * late;
    return true;
  }
  // The tick lies after the pose before: otherwise it would have been due with that pose.
  const auto toward = static_cast<float>((tick_ - before_.time) / (latest_.time - before_.time));
  for (std::size_t i = 0; i < rotations.size(); ++i)
    rotations[i] = slerp(before_.rotations[i], latest_.rotations[i], toward);
  for (std::size_t i = 0; i < plain.size(); ++i)
    plain[i] = before_.plain[i] + toward * (latest_.plain[i] - before_.plain[i]);
  tick_ += period_;
  return true;
}

void FrameClock::begin_run() noexcept {
  poses_ = 0;
  intervals_ = 0;
  tolerance_ = usual_tolerance();
}

void FrameClock::reset() noexcept {
  begin_run();
  started_ = false;
}

}  // namespace gait
