#include "gait/files/whole_file.h"

#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "gait/error.h"

namespace gait {

WholeFile::WholeFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
  part_ += ".part";
  std::error_code ignored;
  const std::filesystem::path folder = path_.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
    throw Error(path_.string() + ": cannot be written: there is no folder " + folder.string());
  if (std::filesystem::is_directory(path_, ignored))
    throw Error(path_.string() + ": cannot be written: it is a folder");
}

WholeFile::~WholeFile() {
  std::error_code ignored;
  if (!kept_) std::filesystem::remove(part_, ignored);
}

void WholeFile::keep() {
  std::error_code failure;
  std::filesystem::rename(part_, path_, failure);
  if (failure) throw Error(path_.string() + ": cannot be written: " + failure.message());
  kept_ = true;
}

void write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  WholeFile file(path);
  std::ofstream stream(file.part(), std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw Error(path.string() + ": cannot be written");
  file.keep();
}

}  // namespace gait
