// Numbers as words, for reports and pictures.
#pragma once

#include <string>

namespace gait::tool {

// `format`: of printf, for one double. Not more than 63 characters come out.
std::string in_words(const char* format, double value);

}  // namespace gait::tool
