// A model with the bone lengths of the performer it reconstructs: it has learnt rotations, which
// hold for bones of any length.
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
