// Recent heading: the facing direction averaged over the last cycle, as CausalHeading has it, for
// frames that come whenever they come.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace gait::osc {

class RecentHeading {
 public:
  explicit RecentHeading(double window_seconds) : window_(window_seconds) {}

  // `right_to_left`: from thigh to thigh in the world. Times ascend. Returns the heading, this
  // frame included.
  double advance(double time, const Eigen::Vector3d& right_to_left) noexcept {
    Eigen::Vector2d facing(-right_to_left.z(), right_to_left.x());
    const double length = facing.norm();
    if (length > 1e-9) facing /= length;
    if (count_ > 0 && time < entries_[(next_ + entries_.size() - 1) % entries_.size()].time)
      count_ = 0;
    entries_[next_] = {time, facing};
    next_ = (next_ + 1) % entries_.size();
    if (count_ < entries_.size()) ++count_;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t back = 1; back <= count_; ++back) {
      const Entry& entry = entries_[(next_ + entries_.size() - back) % entries_.size()];
      // A frame that is as old as the window, but for rounding, is out of it.
      if (time - entry.time > window_ - 0.002) break;
      sum += entry.facing;
    }
    return std::atan2(sum.x(), sum.y());
  }
  void reset() noexcept { count_ = 0; }

 private:
  struct Entry {
    double time;
    Eigen::Vector2d facing;
  };
  double window_;
  std::array<Entry, 512> entries_{};
  std::size_t next_ = 0, count_ = 0;
};

}  // namespace gait::osc
