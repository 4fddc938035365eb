// What `gait info` says of a model's walkers: its spaces of cycles, how few components carry them
// (G04 Table 1), and how often who steps at which speed (G04 eq. 6).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "gait/model/model.h"

namespace gait::tool {

void print_spaces(const Model& model);
nlohmann::ordered_json spaces_as_json(const Model& model);

}  // namespace gait::tool
