// Real walks beside the project, read as the tool reads them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gait/learn/walk_sequences.h"

namespace gait::testing {

// Walks of a folder of the shared data whose file name `wanted` takes; `style` says which style a
// name has, empty: none.
std::vector<Walk> real_walks(const std::string& folder,
                             const std::function<bool(const std::string&)>& wanted,
                             const std::function<std::string(const std::string&)>& style = {});

// "normal" of dataset-2_walk_normal_006.bvh, and its take: 6.
std::string bandai_style(const std::string& name);
int bandai_take(const std::string& name);

}  // namespace gait::testing
