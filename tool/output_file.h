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
  explicit OutputFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
    part_ += ".part";
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
