// The time from a frame's arrival to its leaving: percentiles over the frames since the last
// report.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "pd/outlet.h"

namespace gait::pd {

class Latency {
 public:
  // `seconds` from arrival to leaving. Neither allocates nor throws.
  void add(double seconds) noexcept {
    const double at = std::clamp(1e3 * seconds / bin, 0.0, bins - 1.0);
    ++counts_[static_cast<std::size_t>(at)];
    ++frames_;
    most_ = std::max(most_, 1e3 * seconds);
  }

  // `latency P50 P99 MAX FRAMES`, the first three in milliseconds, since the last time.
  void report(Outlet& info) {
    info.add(percentile(0.5)).add(percentile(0.99)).add(most_).add(frames_).send("latency");
    *this = {};
  }

 private:
  static constexpr double bin = 0.02;  // ms
  static constexpr int bins = 5000;    // to 100 ms; the last one counts all later frames

  // The upper edge of the bin that so many of all frames reach; 0 without frames.
  double percentile(double share) const noexcept {
    double seen = 0;
    for (std::size_t i = 0; i < counts_.size() && frames_ > 0; ++i)
      if ((seen += counts_[i]) >= share * frames_)
        return std::min(most_, bin * static_cast<double>(i + 1));
    return 0;
  }

  std::array<std::uint32_t, bins> counts_{};
  int frames_ = 0;
  double most_ = 0;  // ms
};

}  // namespace gait::pd
