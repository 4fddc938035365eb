// Messages that set one input of a frame to come: `joint J rx ry rz` (relative to the model's
// reference), `quat J x y z w`, `euler J ORDER a b c` (degrees).
#pragma once

#include "gait/play/input/input_stream.h"
#include "pd/arguments.h"

namespace gait::pd {

// Each throws Error, with nothing changed, when the message does not fit the model.
void set_joint(const Arguments& arguments, const Model& model, InputStream& stream);
void set_quaternion(const Arguments& arguments, const Model& model, InputStream& stream);
void set_euler(const Arguments& arguments, const Model& model, InputStream& stream);

}  // namespace gait::pd
