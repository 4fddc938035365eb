// 1-euro filter (Casiez, Roussel, Vogel 2012) on rotations: a low pass whose cutoff rises with
// speed, so that noise is removed at rest and fast movement is not delayed. Each rotation is
// filtered along the shorter way; speeds are in rad/s. Nothing allocates after construction.
#pragma once

#include <algorithm>
#include <numbers>
#include <span>
#include <vector>

#include "gait/motion/rotation.h"

namespace gait {

template <typename Scalar>
class OneEuroFilter {
 public:
  explicit OneEuroFilter(int rotations)
      : last_(static_cast<std::size_t>(rotations), Quaternion<Scalar>::Identity()),
        filtered_(last_),
        speeds_(last_.size(), Scalar(0)) {}

  // Cutoff at rest in Hz, 0 or less: off. `rise`: Hz per rad/s (beta in the paper).
  void set_cutoff(Scalar hertz, Scalar rise = 1) noexcept {
    cutoff_ = hertz > 0 ? hertz : 0;
    rise_ = std::max(Scalar(0), rise);
    if (!on()) started_ = false;
  }
  Scalar cutoff() const noexcept { return cutoff_; }
  bool on() const noexcept { return cutoff_ > 0; }

  // Filters a frame in place, `seconds` after the one before. The first frame passes unchanged, and
  // so does the first after a gap of more than a second or after time stood still or went back.
  // Does nothing while the filter is off or when the number of rotations is another.
  void apply(std::span<Quaternion<Scalar>> rotations, Scalar seconds) noexcept {
    if (!on() || rotations.size() != last_.size()) return;
    if (!(seconds > shortest_gap) || seconds > longest_gap) started_ = false;
    for (std::size_t i = 0; i < last_.size(); ++i) {
      if (!started_) {
        speeds_[i] = 0;
        filtered_[i] = rotations[i];
      } else {
        const Scalar speed = angle_between<Scalar>(last_[i], rotations[i]) / seconds;
        speeds_[i] += gain(speed_cutoff, seconds) * (speed - speeds_[i]);
        filtered_[i] =
            slerp<Scalar>(filtered_[i], rotations[i], gain(cutoff_ + rise_ * speeds_[i], seconds));
      }
      last_[i] = rotations[i];
      rotations[i] = filtered_[i];
    }
    started_ = true;
  }
  // The next frame is the first.
  void reset() noexcept { started_ = false; }

 private:
  static constexpr Scalar speed_cutoff = 1;                       // Hz, as in the paper
  static constexpr Scalar shortest_gap = 1e-6f, longest_gap = 1;  // seconds

  // The paper's alpha: the share of the way from the filtered value to the new one.
  static Scalar gain(Scalar cutoff, Scalar seconds) noexcept {
    const Scalar turns = 2 * std::numbers::pi_v<Scalar> * cutoff * seconds;
    return turns / (turns + 1);
  }

  Scalar cutoff_ = 0, rise_ = 1;
  bool started_ = false;
  std::vector<Quaternion<Scalar>> last_, filtered_;  // the last frame, before and after
  std::vector<Scalar> speeds_;                       // rad/s, filtered
};

}  // namespace gait
