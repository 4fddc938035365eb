// 1-euro filter (Casiez, Roussel, Vogel 2012): a low pass whose cutoff rises with speed, so that
// who stands does not tremble and who moves is not late. Here for rotations: along the shorter way,
// speed in rad/s. Nothing allocates after construction.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace gait {

class OneEuroFilter {
 public:
  OneEuroFilter(int rotations, double frame_rate);

  // Hz at rest; 0: off. `rise`: Hz per rad/s, beta in the paper.
  void set_cutoff(float hertz, float rise = 1) noexcept;
  float cutoff() const noexcept { return cutoff_; }
  bool on() const noexcept { return cutoff_ > 0; }

  // Filters a frame in place.
  void apply(std::span<Eigen::Quaternionf> rotations) noexcept;
  void reset() noexcept { started_ = false; }

 private:
  float share(float cutoff) const noexcept;

  float period_, cutoff_ = 0, rise_ = 1;
  bool started_ = false;
  std::vector<Eigen::Quaternionf> last_, shown_;  // as it came, as it left
  std::vector<float> speeds_;                     // rad/s, filtered at 1 Hz
};

}  // namespace gait
