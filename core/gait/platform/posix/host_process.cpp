#include "gait/platform/host_process.h"

#include <dlfcn.h>
#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <cstdlib>
#include <system_error>

namespace gait {

std::filesystem::path file_of_code(const void* address) {
  Dl_info found{};
  if (dladdr(address, &found) == 0 || found.dli_fname == nullptr) return {};
  std::error_code failure;
  const auto path = std::filesystem::canonical(found.dli_fname, failure);
  return failure ? std::filesystem::path() : path;
}

void* program_function(const char* name) { return dlsym(dlopen(nullptr, RTLD_NOW), name); }

void give_way() noexcept {
#ifdef __linux__
  // There, a priority belongs to a thread.
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10);
#endif
}

std::filesystem::path state_folder() {
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state != '\0')
    return state;
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return std::filesystem::path(home) / ".local" / "state";
  return std::filesystem::temp_directory_path();
}

}  // namespace gait
