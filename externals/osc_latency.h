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
    const double ms = std::max(0.0, 1e3 * seconds);
    const double at = ms < fine ? ms / bin : fine_bins + (ms - fine);
    ++counts_[static_cast<std::size_t>(std::min(at, bins - 1.0))];
    ++frames_;
    most_ = std::max(most_, 1e3 * seconds);
  }

  // `latency P50 P99 MAX FRAMES`, the first three in milliseconds, since the last time.
  void report(Outlet& info) {
    info.add(percentile(0.5)).add(percentile(0.99)).add(most_).add(frames_).send("latency");
    *this = {};
  }

 private:
  // Bins of 0.02 ms to 20 ms, then of 1 ms to 3 s, more than any jitter buffer; the last one counts
  // all later frames.
  static constexpr double bin = 0.02, fine = 20;
  static constexpr int fine_bins = 1000, bins = fine_bins + 2980;

  // The upper edge of the bin that so many of all frames reach; 0 without frames.
  double percentile(double share) const noexcept {
    double seen = 0;
    for (std::size_t i = 0; i < counts_.size() && frames_ > 0; ++i)
      if ((seen += counts_[i]) >= share * frames_) {
        const double edge = static_cast<double>(i + 1);
        return i + 1 == counts_.size()
                   ? most_
                   : std::min(most_, i < fine_bins ? bin * edge : fine + edge - fine_bins);
      }
    return 0;
  }

  std::array<std::uint32_t, bins> counts_{};
  int frames_ = 0;
  double most_ = 0;  // ms
};

}  // namespace gait::pd
