// 1-euro filter (Casiez, Roussel, Vogel 2012) on rotations that come at uneven times: a low pass
// whose cutoff rises with speed, so that a camera's noise goes and quick movement is not late.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace gait::osc {

class RotationFilter {
 public:
  explicit RotationFilter(int rotations);

  // Hz at rest; 0: off. `rise`: Hz per rad/s.
  void set_cutoff(double hertz, double rise = 1) noexcept;
  // Filters a frame in place. `time` in seconds, ascending; a gap of a second starts anew.
  void apply(double time, std::span<Eigen::Quaterniond> rotations) noexcept;
  void reset() noexcept { started_ = false; }

 private:
  double cutoff_ = 0, rise_ = 1, time_ = 0;
  bool started_ = false;
  std::vector<Eigen::Quaterniond> last_, shown_;  // as it came, as it left
  std::vector<double> speeds_;                    // rad/s, filtered at 1 Hz
};

}  // namespace gait::osc
