// How much each of a model's streams moved in training: what the model can recognise and map by.
#pragma once

#include <string>
#include <vector>

#include "gait/model/model.h"

namespace gait {

struct StreamSummary {
  std::string name;
  int values = 0, moving = 0;
  // Root mean square distance from the mean over all training frames: radians of a rotation, its
  // own unit of anything else; 0 when nothing moves.
  double deviation = 0;
};

std::vector<StreamSummary> summaries_of_inputs(const Model& model);
std::vector<StreamSummary> summaries_of_outputs(const Model& model);

// Whether the model knows how its streams go on without input, which the step walker needs.
bool has_trajectories(const Model& model);

}  // namespace gait
