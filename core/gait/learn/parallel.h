// Parallel loop: runs the same work on several threads. Each index runs once, on any thread; its
// result must depend on the index alone, so that results are the same for any number of threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <vector>

#include "gait/joining_thread.h"

namespace gait {

// Number of threads to use; 0 asked: as many as the machine has.
inline int threads_to_use(int asked) {
  const int has = static_cast<int>(std::thread::hardware_concurrency());
  return asked > 0 ? asked : std::max(1, has);
}

// Calls work(i) for i in [0, count). Rethrows the first exception when all threads are done.
template <typename Work>
void in_parallel(int count, int threads, Work work) {
  threads = std::min(threads_to_use(threads), count);
  if (threads <= 1) {
    for (int i = 0; i < count; ++i) work(i);
    return;
  }
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failing;
  {
    std::vector<JoiningThread> team;
    for (int t = 0; t < threads; ++t)
      team.emplace_back([&] {
        for (int i = next++; i < count; i = next++) try {
            work(i);
          } catch (...) {
            const std::scoped_lock lock(failing);
            if (!failure) failure = std::current_exception();
            next = count;
          }
      });
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace gait
