// A file that appears whole or not at all: written beside its place, then renamed.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "gait/error.h"

namespace gait::tool {

class OutputFile {
 public:
  // Throws Error when there is no folder to write to, before any work is done for it.
  explicit OutputFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
    part_ += ".part";
    std::error_code ignored;
    const std::filesystem::path folder = path_.parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
      throw Error(path_.string() + ": cannot be written: there is no folder " + folder.string());
    if (std::filesystem::is_directory(path_, ignored))
      throw Error(path_.string() + ": cannot be written: it is a folder");
  }
  ~OutputFile() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove(part_, ignored);
  }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }  // where it will be
  const std::filesystem::path& part() const { return part_; }  // where to write it

  // Moves the finished file to its place. Throws Error when that cannot be done.
  void keep() {
    std::error_code failure;
    std::filesystem::rename(part_, path_, failure);
    if (failure) throw Error(path_.string() + ": cannot be written: " + failure.message());
    kept_ = true;
  }

 private:
  std::filesystem::path path_, part_;
  bool kept_ = false;
};

}  // namespace gait::tool
