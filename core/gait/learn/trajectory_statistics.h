// Trajectory statistics, which walks without input follow (T14 §4.3): means and variances of inputs
// and outputs and of their centred differences, per state and style.
#pragma once

#include <vector>

#include "gait/learn/alignment.h"
#include "gait/learn/observed.h"
#include "gait/model/model.h"

namespace gait {

// The values of a sequence that move, the inputs' then the outputs', then of all of them the first,
// then the second differences: entries by frames, unscaled.
Eigen::MatrixXd trajectory_of(const Sequence& sequence, const InputLayout& input,
                              const OutputLayout& output);

// Sets trajectory_means and trajectory_variances of the model's states. `sequences` as given to
// observe(), `alignments` one per sequence of `observed`. A style without frames in a state
// gets that state's mean over all styles.
void set_trajectories(Model& model, const std::vector<Sequence>& sequences,
                      const ObservationSet& observed, const StateTable& table,
                      const std::vector<Alignment>& alignments);

}  // namespace gait
