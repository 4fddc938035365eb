// Files read as a whole, and files that appear whole or not at all: written beside their place,
// then renamed. Errors carry the system's own reason.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace gait {

// A file to read, as bytes. Throws Error that begins with the path and names what was `expected`
// ("a BVH file") when it cannot be opened or is a folder.
std::ifstream open_to_read(const std::filesystem::path& path, std::string_view expected);

// All bytes of a file. Throws Error as open_to_read does, and when the file is larger than
// `largest` bytes.
std::string read_whole_file(const std::filesystem::path& path, std::string_view expected,
                            std::uintmax_t largest = std::uintmax_t{1} << 30);

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

  // Writes all bytes to part(). Throws Error when that fails.
  void write(std::string_view bytes) const;

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
