#include "gait/platform/durable_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace gait {

std::error_code replace_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  const int file = open(from.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return {errno, std::generic_category()};
  // Files that cannot be synchronised, as pipes and some network folders, say EINVAL.
  const bool lost = fsync(file) != 0 && errno != EINVAL && errno != ENOTSUP;
  const int reason = errno;
  close(file);
  if (lost) return {reason, std::generic_category()};
  std::error_code failure;
  std::filesystem::rename(from, to, failure);
  return failure;
}

}  // namespace gait
