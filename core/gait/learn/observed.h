// Observed sequences: scaled observations of sequences of values, and their scaling.
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

// Stacks the modelled values (values by frames), their centred first differences and their second
// differences; at the ends the frame itself stands in for the missing neighbour.
Eigen::MatrixXd with_differences(const Eigen::MatrixXd& values, const std::vector<int>& modelled);

// Scales `values` (entries by frames): per entry, less its mean, over its deviation.
Eigen::MatrixXd scaled_by(const Scaling& scaling, const Eigen::MatrixXd& values);

// Makes observations and scales them by their mean and deviation over the frames between each
// sequence's first and last segment. Differences reach `lags` frames back. Frames without that
// history, or without a neighbour for the output's differences, are left out, with their segments.
// x is clipped at `clip` deviations. Throws Error when no input moves or when nothing is left.
ObservationSet observe(const std::vector<Sequence>& sequences, const std::vector<int>& lags,
                       double clip = InputLayout().clip);

}  // namespace gait
