// What differs from system to system stands in core/gait/platform and nowhere else.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

namespace {

namespace fs = std::filesystem;

// FILE:LINE: TEXT of every line that has `what` in it.
std::string lines_with(const std::regex& what, const std::string& but_below) {
  std::string found;
  for (const char* folder : {"core", "osc", "externals", "tool"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(GAIT_SOURCE) / folder)) {
      const fs::path& file = entry.path();
      if (file.extension() != ".cpp" && file.extension() != ".h") continue;
      if (file.generic_string().find(but_below) != std::string::npos) continue;
      std::ifstream stream(file);
      int number = 0;
      for (std::string line; ++number, std::getline(stream, line);)
        if (std::regex_search(line, what))
          found += file.generic_string() + ":" + std::to_string(number) + ": " + line + "\n";
    }
  return found;
}

TEST(Seam, headers_of_systems_are_included_in_one_room) {
  const std::regex headers(
      "#include <(unistd|fcntl|poll|dlfcn|netdb|spawn|pthread|windows|winsock2|ws2tcpip|io|"
      "(sys|arpa|netinet)/.*)\\.h>");
  EXPECT_NE(lines_with(headers, "nowhere"), "") << "the search finds nothing at all";
  EXPECT_EQ(lines_with(headers, "core/gait/platform/posix/"), "");
}

// path_from_utf8 and utf8_of are the way in and out.
TEST(Seam, paths_are_no_narrow_strings) {
  const std::regex narrow("\\.(generic_)?string\\(\\)|u8path|fopen\\(");
  EXPECT_NE(lines_with(std::regex("path_from_utf8\\("), "nowhere"), "")
      << "the search finds nothing at all";
  EXPECT_EQ(lines_with(narrow, "core/gait/platform/"), "");
}

}  // namespace
