// The cycle spaces of a model in its file: written, read and checked.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "gait/model/model.h"
#include "gait/model/model_field.h"

namespace gait {

nlohmann::json field_of(const CycleSpace& space);
nlohmann::json field_of(const StyleSpace& space);
nlohmann::json field_of(const SpeedSpace& space);

// Throw Error naming the field that is missing or of another kind.
CycleSpace cycle_space(const ModelField& field);
StyleSpace style_space(const ModelField& field);
SpeedSpace speed_space(const ModelField& field);

// Throws Error naming the field when one of the model's spaces cannot be walked in.
void check_cycle_spaces(const Model& model);

}  // namespace gait
