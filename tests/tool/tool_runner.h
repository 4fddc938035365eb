// Runs the real program as a user would, and keeps what it said.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gait::testing {

struct ToolRun {
  int exit_code = -1;
  std::string out, err;
};

// `arguments` after the program's name. `search_path`: PATH of the process, empty: this one's.
ToolRun run_tool(const std::vector<std::string>& arguments, const std::string& search_path = "");

// A folder of its own for the running test, emptied at the start and removed at the end.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

std::string bytes_of(const std::string& path);
void write_file(const std::string& path, const std::string& text);

// How many lines stderr had; errors are promised to be one.
int lines_of(const std::string& text);

bool ffmpeg_is_there();

}  // namespace gait::testing
