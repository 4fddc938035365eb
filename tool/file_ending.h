// What a file's name ends in, which says what kind of file it is.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

#include "gait/platform/path_text.h"

namespace gait::tool {

// With its dot, in lower case: ".svg". Empty when the name has none.
inline std::string ending_of(const std::filesystem::path& path) {
  std::string ending = utf8_of(path.extension());
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace gait::tool
