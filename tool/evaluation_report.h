// What `gait evaluate` says: a table that explains itself, or every figure as JSON.
#pragma once

#include "gait/judge/evaluation.h"

namespace gait::tool {

void print_table(const Evaluation& evaluation, const Model& model);
void print_json(const Evaluation& evaluation, const Model& model);

}  // namespace gait::tool
