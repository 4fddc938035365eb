// Stands before malloc, its relatives and operator new: forbids the calling thread to allocate, or
// counts the bytes that it takes.
#pragma once

namespace gait::testing {

// Makes memory unavailable to the calling thread for as long as an object of it lives: what it asks
// for fails, and is counted, as is every free.
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

// The bytes that the calling thread took since the object was made, less those it gave back. It
// works where ForbiddenMemory does.
class TakenMemory {
 public:
  TakenMemory() noexcept;
  long bytes() const noexcept;

 private:
  long before_;
};

}  // namespace gait::testing
