// Checks of a model's spaces of cycles.
#pragma once

#include "gait/model/model.h"

namespace gait {

// Throws Error naming the field when a style walker or speed walker cannot walk in one of the
// model's spaces.
void check_cycle_spaces(const Model& model);

}  // namespace gait
