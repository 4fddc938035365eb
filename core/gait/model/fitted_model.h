// A model on the bones of whoever is reconstructed: rotations are learnt, lengths are the wearer's.
#pragma once

#include <memory>
#include <vector>

#include "gait/model/model.h"

namespace gait {

// The model with the offsets and tips of `skeleton` (metres, Y up) where its joints were matched
// (match_joints; -1: not), so that the root travels as far as these legs reach. The model must have
// a body.
std::shared_ptr<const Model> fitted_model(const Model& model, const Skeleton& skeleton,
                                          const std::vector<int>& matched);

}  // namespace gait
