// Reads styles on the command line: a name, or names with weights.
#pragma once

#include <string>
#include <vector>

#include "gait/offline/planned_walk.h"

namespace gait::tool {

// "proud" or "proud=0.7,sad=0.3". Throws UsageError that names `option`.
std::vector<StyleShare> parse_mix(const std::string& text, const std::string& option);

// "sad@4": in sad from the fourth second on; a mix is understood too.
StyleChange parse_change(const std::string& text, const std::string& option);

}  // namespace gait::tool
