// The Gaussian that a walk by itself follows at one moment: between two states, over the styles by
// weights, at the speed with which the states are walked through.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "gait/play/output_gaussian.h"
#include "gait/play/synthesise/step_tables.h"

namespace gait {

class StepGaussian {
 public:
  // `period`: of a frame, seconds.
  StepGaussian(std::shared_ptr<const StepTables> tables, float period);

  struct Moment {
    int label = 0;
    int before = -1, next = -1;  // the labels around it; -1: none
    float progress = 0;          // through the label, 0..1
    float duration = 1;          // of the label as it is walked, seconds; 0: it stands
  };
  // `weights`: per style, sum 1. Valid until the next call.
  const OutputGaussian& at(const Moment& moment, const Eigen::VectorXf& weights) noexcept;

 private:
  void add(std::size_t state, float share, const Eigen::VectorXf& weights) noexcept;

  std::shared_ptr<const StepTables> tables_;
  float period_;
  OutputGaussian gaussian_;
  Eigen::VectorXf rates_, shares_;  // per style
};

}  // namespace gait
