// Statistics that walks without input follow (T14 §4.3): of inputs and outputs alike, per state and
// style, values and their centred differences.
#pragma once

#include <vector>

#include "gait/learn/alignment.h"
#include "gait/learn/observed.h"
#include "gait/model/model.h"

namespace gait {

// Sets trajectory_means and trajectory_variances of the model's states. `sequences` as given to
// observe(), `alignments` one per sequence of `observed`. A style that never passed through a state
// gets the mean of all there.
void set_trajectories(Model& model, const std::vector<Sequence>& sequences,
                      const ObservationSet& observed, const StateTable& table,
                      const std::vector<Alignment>& alignments);

}  // namespace gait
