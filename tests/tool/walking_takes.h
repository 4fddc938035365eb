// A few short walks in two styles, and a model learnt from them in a moment.
#pragma once

#include <string>
#include <vector>

#include "tool_runner.h"

namespace gait::testing {

// One take of a corpus style; another take is another passage of the same actor.
void write_take(const std::string& path, const std::string& style, int take, int cycles = 4,
                double frame_rate = 30);

// Takes `first` to `last` of proud and sad as walk_STYLE_TAKE.bvh. Returns the folder.
std::string write_takes(const std::string& folder, int first = 1, int last = 3);

// `gait train` of what `clips` name, with little to choose, so that it takes a moment. `more` goes
// after.
ToolRun train_quickly(const std::vector<std::string>& clips, const std::string& model,
                      const std::vector<std::string>& more = {});

}  // namespace gait::testing
