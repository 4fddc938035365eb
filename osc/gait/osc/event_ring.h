// Event ring: a lock-free queue of fixed size from one writing thread to one reading thread. When
// it is full it refuses new entries.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <vector>

namespace gait::osc {

template <typename T>
class EventRing {
 public:
  // Holds at least `capacity` entries.
  explicit EventRing(std::size_t capacity) : entries_(std::bit_ceil(capacity)) {}

  // For the writing thread. Returns false, and drops the entry, when the ring is full.
  bool push(const T& entry) noexcept {
    const std::size_t at = written_.load(std::memory_order_relaxed);
    if (at - read_.load(std::memory_order_acquire) >= entries_.size()) return false;
    entries_[at & (entries_.size() - 1)] = entry;
    written_.store(at + 1, std::memory_order_release);
    return true;
  }
  // For the reading thread. Returns false when the ring is empty.
  bool pop(T& entry) noexcept {
    const std::size_t at = read_.load(std::memory_order_relaxed);
    if (at == written_.load(std::memory_order_acquire)) return false;
    entry = entries_[at & (entries_.size() - 1)];
    read_.store(at + 1, std::memory_order_release);
    return true;
  }

 private:
  std::vector<T> entries_;
  alignas(64) std::atomic<std::size_t> written_{0};
  alignas(64) std::atomic<std::size_t> read_{0};
};

}  // namespace gait::osc
