// Paths and text. All text of the project is UTF-8: arguments, Pd's symbols, manifests. Every path
// enters here, and files are opened by std::filesystem::path alone, for where a system's narrow
// strings are not UTF-8 they would name other files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gait {

// The path that UTF-8 names. Where paths are bytes, as on Linux, any other bytes pass unchanged.
// Throws Error where the system cannot name such a file.
std::filesystem::path path_from_utf8(std::string_view text);

// The path as text, for errors and reports. path_from_utf8 gives the path back.
std::string utf8_of(const std::filesystem::path& path);

}  // namespace gait
