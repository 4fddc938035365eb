// A thread that is joined when its object goes. std::jthread would do, but libc++ before version 20
// has none.
#pragma once

#include <thread>
#include <utility>

namespace gait {

class JoiningThread {
 public:
  JoiningThread() = default;
  template <typename Work>
  explicit JoiningThread(Work work) : thread_(std::move(work)) {}
  JoiningThread(JoiningThread&&) = default;
  JoiningThread& operator=(JoiningThread&& other) noexcept {
    join();
    thread_ = std::move(other.thread_);
    return *this;
  }
  ~JoiningThread() { join(); }

  void join() noexcept {
    if (thread_.joinable()) thread_.join();
  }

 private:
  std::thread thread_;
};

}  // namespace gait
