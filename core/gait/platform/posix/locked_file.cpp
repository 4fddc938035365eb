#include "gait/platform/locked_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace gait {

namespace {

int descriptor(std::intptr_t file) { return static_cast<int>(file); }

std::error_code last_error() { return {errno, std::generic_category()}; }

}  // namespace

LockedFile::LockedFile(std::filesystem::path path, std::intptr_t file)
    : path_(std::move(path)), file_(file) {}

LockedFile::~LockedFile() { close(descriptor(file_)); }

std::unique_ptr<LockedFile> LockedFile::open(const std::filesystem::path& path,
                                             std::error_code& failure) {
  failure.clear();
  while (true) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    if (file < 0) {
      failure = last_error();
      return nullptr;
    }
    std::unique_ptr<LockedFile> locked(new LockedFile(path, file));
    if (flock(file, LOCK_EX | LOCK_NB) != 0) {
      failure = errno == EWOULDBLOCK ? std::make_error_code(std::errc::device_or_resource_busy)
                                     : last_error();
      return nullptr;
    }
    // The owner before may have removed it or renamed it since it was opened.
    struct stat here {
    }, there{};
    if (fstat(file, &here) == 0 && stat(path.c_str(), &there) == 0 && here.st_ino == there.st_ino &&
        here.st_dev == there.st_dev)
      return locked;
  }
}

std::uintmax_t LockedFile::size() const {
  struct stat status {};
  return fstat(descriptor(file_), &status) == 0 ? static_cast<std::uintmax_t>(status.st_size) : 0;
}

std::error_code LockedFile::append(std::string_view bytes) {
  const auto before = static_cast<off_t>(size());
  while (!bytes.empty()) {
    const ssize_t count = write(descriptor(file_), bytes.data(), bytes.size());
    if (count >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      const std::error_code failure = last_error();
      // Otherwise a half of it would stand before what is written next.
      [[maybe_unused]] const int cut = ftruncate(descriptor(file_), before);
      return failure;
    }
  }
  if (fsync(descriptor(file_)) != 0 && errno != EINVAL && errno != ENOTSUP) return last_error();
  return {};
}

std::error_code LockedFile::rename(const std::filesystem::path& to) {
  std::error_code failure;
  std::filesystem::rename(path_, to, failure);
  if (!failure) path_ = to;
  return failure;
}

std::error_code LockedFile::remove() {
  std::error_code failure;
  std::filesystem::remove(path_, failure);
  return failure;
}

}  // namespace gait
