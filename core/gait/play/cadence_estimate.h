// Cadence from decisions: labels per second over the last cycle, for a walk steps per second.
//
// Phase estimates, unwrapped, are a line whose slope is the cadence. It is fitted by least squares
// over the last whole cycle, so that a long step beside a short one (a limp) does not make it sway.
#pragma once

#include <vector>

#include "gait/play/recognise/phase_estimate.h"

namespace gait {

class CadenceEstimator {
 public:
  // `frame_rate`: of the decisions. Looks back `longest` seconds at most, at least two frames.
  // Throws Error when frame_rate is not positive, or `longest` not between 0 and 60 s.
  explicit CadenceEstimator(double frame_rate, double longest = 4);

  // The next frame's phase, in a cycle of `labels` labels. A change of their number begins anew.
  void advance(double phase, int labels) noexcept;

  // Labels per second, never negative; 0 until half a label has passed.
  float cadence() const noexcept { return cadence_; }
  void reset() noexcept;

 private:
  double frame_rate_;
  std::vector<double> positions_;  // ring: labels passed since reset
  int newest_ = 0, count_ = 0, labels_ = 0;
  double phase_ = 0;
  float cadence_ = 0;
};

}  // namespace gait
