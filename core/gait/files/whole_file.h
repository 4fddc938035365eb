// Files that appear whole or not at all: written beside their place, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

namespace gait {

class WholeFile {
 public:
  // Throws Error when the folder of `path` does not exist or `path` is a folder, so that callers
  // learn it before they compute what to write.
  explicit WholeFile(std::filesystem::path path);
  ~WholeFile();  // removes the unfinished file unless it was kept
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  const std::filesystem::path& path() const { return path_; }  // where it will be
  const std::filesystem::path& part() const { return part_; }  // where to write it

  // Moves the finished file to its place. Throws Error when that fails.
  void keep();

 private:
  std::filesystem::path path_, part_;
  bool kept_ = false;
};

// Writes all bytes to a file at once. Throws Error when that fails; a file that stood there before
// then stays as it was.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace gait
