// From sequences of values to scaled observations, and the scaling itself.
#pragma once

#include <vector>

#include "gait/learn/sequence.h"
#include "gait/motion/observation.h"

namespace gait {

struct ObservationSet {
  InputLayout input;
  OutputLayout output;
  Scaling input_scaling, output_scaling;
  Eigen::VectorXd output_mean;  // per output value
  Eigen::VectorXd input_mean;   // per input value
  std::vector<ObservedSequence> sequences;
};

// Values whose deviation over all used frames is below this are not modelled but copied (radians,
// or the stream's unit).
inline constexpr double least_deviation = 1e-3;

// Of values by frames the modelled ones, then their centred first, then second differences; at the
// ends the neighbour that is missing is the frame itself.
Eigen::MatrixXd with_differences(const Eigen::MatrixXd& values, const std::vector<int>& modelled);

// Lays observations out and scales them by mean and deviation over the frames between each
// sequence's first and last segment. Differences reach `lags` frames back; frames that lack the
// history, or a neighbour for the output's differences, are left out, and segments with them.
// Throws Error when no input moves or when nothing is left.
ObservationSet observe(const std::vector<Sequence>& sequences, const std::vector<int>& lags);

}  // namespace gait
