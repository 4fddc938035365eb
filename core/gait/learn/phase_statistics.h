// Phases of states: where in the cycle of labels a frame of a state is, and how that goes with what
// is observed. An observation so says the phase more finely than its state does.
#pragma once

#include <vector>

#include "gait/learn/alignment.h"
#include "gait/learn/observed.h"
#include "gait/model/model.h"

namespace gait {

// Sets phase and phase_covariance of the model's states, if its labels follow each other in one
// ring. `sequences` as given to observe(), `alignments` one per sequence of `observed`. The
// covariance is shrunk as if `regularisation` more frames had none, as the states' own are.
void set_phases(Model& model, const std::vector<Sequence>& sequences,
                const ObservationSet& observed, const StateTable& table,
                const std::vector<Alignment>& alignments, double regularisation);

}  // namespace gait
