#include "gait/platform/path_text.h"

#include <system_error>

#include "gait/error.h"

namespace gait {

std::filesystem::path path_from_utf8(std::string_view text) {
  try {
    return std::u8string(text.begin(), text.end());
  } catch (const std::system_error&) {
    throw Error("expected the name of a file in UTF-8, found '" + std::string(text) + "'");
  }
}

std::string utf8_of(const std::filesystem::path& path) {
  const std::u8string text = path.u8string();
  return {text.begin(), text.end()};
}

}  // namespace gait
