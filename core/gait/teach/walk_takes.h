// Learning to walk from takes that a patch recorded: whole poses of a body, a style per take. Steps
// are found in them as in any clip.
#pragma once

#include <string>
#include <vector>

#include "gait/teach/takes_file.h"
#include "gait/teach/walk_model.h"

namespace gait {

// A model of walking with the steps, styles and the space of styles of these takes: poses (inputs:
// three values per joint of `body`, rotation vectors relative to its references; outputs: none)
// that become walks on the spot, with the label as style. Joints are measured and synthesised as
// `body` has it. Throws Error naming a take of another size, and as learn_walks does.
TakesLearnt learn_walk_takes(const std::vector<RecordedTake>& takes, const Body& body,
                             const std::string& name, const TakeOptions& options = {});

}  // namespace gait
