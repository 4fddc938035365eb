#include "play/forbidden_memory.h"

#include <cerrno>
#include <cstddef>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GAIT_STANDS_BEFORE_MALLOC 1
#else
#define GAIT_STANDS_BEFORE_MALLOC 0
#endif

namespace {

thread_local bool forbidden = false;
thread_local long allocations_seen = 0, releases_seen = 0, bytes_taken = 0;

}  // namespace

#if GAIT_STANDS_BEFORE_MALLOC

// The C library's own functions under their other names.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
std::size_t malloc_usable_size(void*);

[[gnu::visibility("default")]] void* malloc(std::size_t);
[[gnu::visibility("default")]] void* calloc(std::size_t, std::size_t);
[[gnu::visibility("default")]] void* realloc(void*, std::size_t);
[[gnu::visibility("default")]] void* aligned_alloc(std::size_t, std::size_t);
[[gnu::visibility("default")]] int posix_memalign(void**, std::size_t, std::size_t);
[[gnu::visibility("default")]] void free(void*);
}

namespace {

bool refused() noexcept {
  if (!forbidden) return false;
  ++allocations_seen;
  errno = ENOMEM;
  return true;
}

void* taken(void* memory) noexcept {
  if (memory) bytes_taken += static_cast<long>(malloc_usable_size(memory));
  return memory;
}
void given_back(void* memory) noexcept {
  if (memory) bytes_taken -= static_cast<long>(malloc_usable_size(memory));
}

}  // namespace

void* malloc(std::size_t size) { return refused() ? nullptr : taken(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) {
  return refused() ? nullptr : taken(__libc_calloc(count, size));
}
void* realloc(void* memory, std::size_t size) {
  if (refused()) return nullptr;
  given_back(memory);
  return taken(__libc_realloc(memory, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return refused() ? nullptr : taken(__libc_memalign(alignment, size));
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  if (refused()) return ENOMEM;
  *memory = taken(__libc_memalign(alignment, size));
  return *memory == nullptr ? ENOMEM : 0;
}
void free(void* memory) {
  if (forbidden && memory != nullptr) ++releases_seen;
  given_back(memory);
  __libc_free(memory);
}

#endif

namespace gait::testing {

ForbiddenMemory::ForbiddenMemory() noexcept {
  allocations_seen = releases_seen = 0;
  forbidden = true;
}
ForbiddenMemory::~ForbiddenMemory() { forbidden = false; }
long ForbiddenMemory::allocations() const noexcept { return allocations_seen; }
long ForbiddenMemory::releases() const noexcept { return releases_seen; }
TakenMemory::TakenMemory() noexcept : before_(bytes_taken) {}
long TakenMemory::bytes() const noexcept { return bytes_taken - before_; }
bool ForbiddenMemory::works() noexcept { return GAIT_STANDS_BEFORE_MALLOC; }

}  // namespace gait::testing
