// Learning to walk from what a patch recorded: whole poses of a body, a style per take. Steps are
// found in them as in any clip; nobody has to say where one begins.
#pragma once

#include <string>
#include <vector>

#include "gait/teach/takes_file.h"
#include "gait/teach/walk_model.h"

namespace gait {

// Takes of poses (inputs: three values per joint of the body, rotation vectors relative to its
// references; outputs: none) as walks on the spot, label as style. Throws Error naming a take of
// another size.
std::vector<Walk> walks_of_takes(const std::vector<RecordedTake>& takes, const Body& body);

// A model of walking with the steps, styles and the space of styles of these takes. Joints are
// measured and synthesised as `body` has it. Throws Error as select_walk_model does.
TakesLearnt learn_walk_takes(const std::vector<RecordedTake>& takes, const Body& body,
                             const std::string& name, const TakeOptions& options = {});

}  // namespace gait
