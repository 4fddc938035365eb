#include "gait/platform/whole_file.h"

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "gait/error.h"
#include "gait/platform/durable_file.h"
#include "gait/platform/path_text.h"

namespace gait {

namespace {

// Why the last operation on a stream failed. Standard streams do not say; beneath all of them the
// system leaves its reason in errno.
std::string reason() {
  return errno != 0 ? ": " + std::generic_category().message(errno) : std::string();
}

[[noreturn]] void refuse(const std::filesystem::path& path, std::string_view expected,
                         const std::string& found) {
  throw Error(utf8_of(path) + ": expected " + std::string(expected) + found);
}

}  // namespace

std::ifstream open_to_read(const std::filesystem::path& path, std::string_view expected) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse(path, expected, ", found a folder");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(path, expected, ", cannot open it" + reason());
  return stream;
}

std::string read_whole_file(const std::filesystem::path& path, std::string_view expected,
                            std::uintmax_t largest) {
  std::ifstream stream = open_to_read(path, expected);
  std::string bytes;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  if (!unknown && size <= largest) bytes.reserve(size);
  std::array<char, 1 << 16> block;
  errno = 0;
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0) {
    bytes.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > largest)
      refuse(path, expected,
             " of at most " + std::to_string(largest >> 20) + " MiB, found a larger one");
  }
  if (stream.bad()) refuse(path, expected, ", cannot read it to its end" + reason());
  return bytes;
}

WholeFile::WholeFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
  part_ += ".part";
  std::error_code ignored;
  const std::filesystem::path folder = path_.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
    throw Error(utf8_of(path_) + ": cannot be written: there is no folder " + utf8_of(folder));
  if (std::filesystem::is_directory(path_, ignored))
    throw Error(utf8_of(path_) + ": cannot be written: it is a folder");
}

WholeFile::~WholeFile() {
  std::error_code ignored;
  if (!kept_) std::filesystem::remove(part_, ignored);
}

void WholeFile::write(std::string_view bytes) const {
  errno = 0;
  std::ofstream stream(part_, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw Error(utf8_of(path_) + ": cannot be written" + reason());
}

void WholeFile::keep() {
  if (const std::error_code failure = replace_file(part_, path_))
    throw Error(utf8_of(path_) + ": cannot be written: " + failure.message());
  kept_ = true;
}

void write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  WholeFile file(path);
  file.write(bytes);
  file.keep();
}

}  // namespace gait
