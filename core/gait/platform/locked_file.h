// A file that one owner appends to, locked against all others: a journal.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>

namespace gait {

class LockedFile {
 public:
  // Opens a file, made when missing. Null when that fails; `failure` says why:
  // std::errc::device_or_resource_busy when another owner, in this program or another, has locked
  // it. Nobody waits.
  static std::unique_ptr<LockedFile> open(const std::filesystem::path& path,
                                          std::error_code& failure);
  ~LockedFile();  // closes it, which unlocks it
  LockedFile(const LockedFile&) = delete;
  LockedFile& operator=(const LockedFile&) = delete;

  std::uintmax_t size() const;  // bytes

  // Writes at the end, all bytes or none, and on to the disk. Returns why it failed.
  std::error_code append(std::string_view bytes);
  // Gives the file another name while it stays open and locked.
  std::error_code rename(const std::filesystem::path& to);
  std::error_code remove();

  const std::filesystem::path& path() const { return path_; }

 private:
  LockedFile(std::filesystem::path path, std::intptr_t file);

  std::filesystem::path path_;
  std::intptr_t file_;  // the system's handle
};

}  // namespace gait
