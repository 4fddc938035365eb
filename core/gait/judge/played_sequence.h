// A sequence played through a model, with what the truth says beside it.
#pragma once

#include <memory>
#include <vector>

#include "gait/learn/sequence.h"
#include "gait/play/stream_reconstructor.h"

namespace gait {

struct PlayedSequence {
  int begin = 0, end = 0;            // frames that count: between the first and last segment
  Eigen::MatrixXd outputs;           // output values by frames, delays realigned
  std::vector<Decision> decisions;   // per frame
  Eigen::MatrixXf style_posteriors;  // styles by frames
  std::vector<int> true_label;       // per frame, -1 outside the segments
};

PlayedSequence play_sequence(const PlayModel& played_model, const PlaySettings& settings,
                             const Sequence& sequence);

// Distance of two output vectors per stream at one frame: the geodesic angle (radians) for
// rotations, the mean absolute difference for plain values.
Eigen::VectorXd stream_errors(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& a,
                              const Eigen::Ref<const Eigen::VectorXd>& b);

}  // namespace gait
