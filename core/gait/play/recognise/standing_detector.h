// Walking or standing, from the input alone: who stands, or turns on the spot, hardly moves.
//
// Activity is how much the inputs change over about a sixth of a second, averaged over 0.7 s, as a
// share of what they changed in training (root of the ratio of sums over all values, so that joints
// that hardly move do not speak). What a shorter difference shows besides is a sensor's noise, and
// is taken off. Thresholds lie below the quietest style the model knows, with hysteresis. Measured
// on the built-in corpus and on captured walks: tests/play/standing_detector_test.cpp.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "gait/model/model.h"

namespace gait {

class StandingDetector {
 public:
  explicit StandingDetector(const Model& model);

  // Takes a frame of model.input.values values, all finite, at the model's rate. Says whether it is
  // walked: true from the start until standing shows.
  bool advance(std::span<const float> values) noexcept;

  bool walking() const noexcept { return walking_; }
  float activity() const noexcept { return activity_; }  // about 1 for the mean of what was taught

  // A missing value does not count, nor, when it comes back, before its history is real.
  void set_missing(int value, bool missing) noexcept;
  void reset() noexcept;

 private:
  float energy() const noexcept;

  std::vector<int> modelled_;
  int long_lag_ = 0, short_lag_ = 0;  // frames; 0: the model has no differences, all is walking
  float slow_share_ = 1;       // of a slow movement's long difference that noise's removal leaves
  Eigen::VectorXf weight_;     // per modelled value: into a unit that all share
  Eigen::VectorXf learnt_;     // per modelled value: weighted square of training's long differences
  std::vector<bool> missing_;  // per input value
  Eigen::ArrayXi there_;       // per modelled value: frames in a row
  Eigen::MatrixXf history_;    // ring of columns, modelled values each
  std::vector<float> energies_;  // ring
  int newest_ = 0, frames_ = 0;
  float standing_below_ = 0, walking_above_ = 0;  // of the activity
  float activity_ = 1;
  bool walking_ = true;
};

}  // namespace gait
