// What a trajectory is to follow at one frame, in the outputs' own units: a Gaussian over statics,
// then first, then second differences, each per modelled output value.
#pragma once

#include <Eigen/Core>

namespace gait {

struct OutputGaussian {
  Eigen::VectorXf mean, variance;
};

}  // namespace gait
