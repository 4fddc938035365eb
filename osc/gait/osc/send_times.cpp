#include "gait/osc/send_times.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gait::osc {

namespace {

constexpr double longest_gap = 0.7;  // seconds; after it all begins anew
constexpr double least_span = 0.25;  // seconds, to compare two clocks over
constexpr int least_frames = 8;      // to know the period, or to trust a clock
constexpr int stride = 16;           // intervals, over which the period is measured
constexpr int late_in_a_row = 5;     // frames; then others before them were lost
constexpr double lost = 0.6;         // of a period
constexpr int most_shifts = 4;       // one after another
constexpr int clock_window = 192, number_window = 192;  // frames

}  // namespace

template <class Time>
double SendTimes::least_delay(int frames, Time time) const noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (int back = 0; back < std::min(frames, count_); ++back)
    least = std::min(least, at(back).arrived - time(at(back)));
  return least;
}

double SendTimes::next(double arrived, double sent) noexcept {
  if (count_ > 0 && (arrived - at(0).arrived > longest_gap || arrived < at(0).arrived)) reset();
  const bool goes_on = count_ > 0 && sent > at(0).sent && clocked_ > 0;
  clocked_ = std::isfinite(sent) ? (goes_on ? std::min(clocked_ + 1, most) : 1) : 0;
  const double number = count_ > 0 ? at(0).number + 1 : 0;
  latest_ = (latest_ + 1) % most;
  count_ = std::min(count_ + 1, most);
  at(0) = {arrived, sent, number};
  const double counted = by_number();  // kept up, for a clock that stops
  return clock_agrees() ? by_clock() : counted;
}

// Its unit is what makes it go as fast as the arrivals do.
bool SendTimes::clock_agrees() const noexcept {
  if (clocked_ < least_frames) return false;
  const Frame &now = at(0), &then = at(std::min(clocked_, count_) - 1);
  const double span = now.arrived - then.arrived;
  if (span < least_span) return false;
  const double ratio = (now.sent - then.sent) / span;
  // What is held up now may be late by all of a buffer.
  const double slack = 0.05 + 0.35 / span;
  return std::abs(ratio - 1) < slack || std::abs(ratio / 1000 - 1) < slack;
}

double SendTimes::by_clock() noexcept {
  const Frame &now = at(0), &then = at(std::min(clocked_, count_) - 1);
  const double ratio = (now.sent - then.sent) / (now.arrived - then.arrived);
  unit_ = ratio > 30 ? 1e-3 : 1;
  const auto time = [&](const Frame& frame) { return unit_ * (frame.sent - now.sent); };
  return least_delay(std::min(clocked_, clock_window), time);
}

// The period: the median over stretches of several frames, because a network that holds frames up
// hands them over in bunches; then the slope of the line through the latest arrivals, without those
// that were held up.
void SendTimes::find_period() noexcept {
  std::array<double, most> periods{};
  const int step = std::min(stride, numbered_ - 1);
  int found = 0;
  for (int back = 0; back + step < numbered_; ++back) {
    const double frames = at(back).number - at(back + step).number;
    periods[static_cast<std::size_t>(found++)] =
        (at(back).arrived - at(back + step).arrived) / frames;
  }
  const auto middle = periods.begin() + found / 2;
  std::nth_element(periods.begin(), middle, periods.begin() + found);
  period_ = *middle;
  if (numbered_ < 2 * stride) return;
  double most_late = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 3; ++round) {
    const double slope = slope_below(most_late);
    if (std::abs(slope / period_ - 1) > 0.3) return;
    period_ = slope;
    for (int back = 0; back < numbered_; ++back)
      periods[static_cast<std::size_t>(back)] = lateness(back);
    const auto half = periods.begin() + numbered_ / 2;
    std::nth_element(periods.begin(), half, periods.begin() + numbered_);
    most_late = *half;
  }
}

// Least squares of arrivals over numbers, of frames that are no later than that.
double SendTimes::slope_below(double most_late) const noexcept {
  double number = 0, time = 0, squares = 0, products = 0;
  int count = 0;
  for (int back = 0; back < numbered_; ++back) {
    if (lateness(back) > most_late) continue;
    ++count;
    number += (at(back).number - at(0).number - number) / count;
    time += (at(back).arrived - at(0).arrived - time) / count;
  }
  for (int back = 0; back < numbered_; ++back) {
    if (lateness(back) > most_late) continue;
    const double n = at(back).number - at(0).number - number;
    squares += n * n;
    products += n * (at(back).arrived - at(0).arrived - time);
  }
  return squares > 0 ? products / squares : period_;
}

// Against the number of the latest frame, at the present period.
double SendTimes::lateness(int back) const noexcept {
  return at(back).arrived - at(0).arrived + period_ * (at(0).number - at(back).number);
}

// Whether the last frames are as late as if others before them had been lost: late by a period and
// more, and steadily so. Frames that were held up catch up.
bool SendTimes::some_were_lost(double& late) const noexcept {
  if (numbered_ <= 2 * late_in_a_row) return false;
  std::array<double, number_window> all{};
  const int count = std::min(numbered_, number_window);
  for (int back = 0; back < count; ++back) all[static_cast<std::size_t>(back)] = lateness(back);
  double mean = 0, least = all[0];
  for (int back = 0; back < late_in_a_row; ++back) {
    mean += all[static_cast<std::size_t>(back)] / late_in_a_row;
    least = std::min(least, all[static_cast<std::size_t>(back)]);
  }
  const double fallen = all[late_in_a_row - 1] - all[0];
  const auto earlier = all.begin() + late_in_a_row;
  const auto middle = earlier + (count - late_in_a_row) / 2;
  std::nth_element(earlier, middle, all.begin() + count);
  const double usual = *middle;
  late = mean - usual;
  const double bottom = *std::min_element(all.begin(), all.begin() + count);
  return late > lost * period_ && least - bottom > 0.5 * period_ &&
         fallen < 0.5 * late_in_a_row * period_;
}

double SendTimes::by_number() noexcept {
  numbered_ = std::min(numbered_ + 1, count_);
  if (numbered_ < least_frames) {
    period_ = 0;
    return at(0).arrived;
  }
  // What a few frames more would change in many is little.
  if (numbered_ < most / 2 || latest_ % 8 == 0) find_period();
  if (period_ <= 0) return at(0).arrived;
  const auto time = [&](const Frame& frame) { return period_ * (frame.number - at(0).number); };
  double late = 0;
  if (some_were_lost(late)) {
    const double shift = std::max(1.0, std::round(late / period_));
    if (++shifts_ >= most_shifts || shift > 120) {
      // The period is wrong: of a burst, or the sender's rate has changed.
      numbered_ = 1;
      period_ = 0;
      shifts_ = 0;
      return at(0).arrived;
    }
    for (int back = 0; back < late_in_a_row; ++back) at(back).number += shift;
    since_shift_ = 0;
  } else if (++since_shift_ > 4 * late_in_a_row) {
    shifts_ = 0;
  }
  return least_delay(std::min(numbered_, number_window), time);
}

}  // namespace gait::osc
