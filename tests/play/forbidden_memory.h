// Makes memory unavailable to the calling thread for as long as an object of it lives: malloc, its
// relatives and operator new then fail, and are counted, as is every free.
#pragma once

namespace gait::testing {

class ForbiddenMemory {
 public:
  ForbiddenMemory() noexcept;
  ~ForbiddenMemory();
  ForbiddenMemory(const ForbiddenMemory&) = delete;
  ForbiddenMemory& operator=(const ForbiddenMemory&) = delete;

  // Of this thread, since the object was made.
  long allocations() const noexcept;
  long releases() const noexcept;
  // Whether it works in this build: sanitizers bring their own memory and cannot be stood between.
  static bool works() noexcept;
};

}  // namespace gait::testing
