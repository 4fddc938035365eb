#include "number_words.h"

#include <array>
#include <cstdio>

namespace gait::tool {

std::string in_words(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

}  // namespace gait::tool
