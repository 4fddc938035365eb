// Ctrl-C, and the system's wish that the program end.
#pragma once

#include <functional>
#include <memory>

namespace gait {

// While it lives, the first Ctrl-C (or SIGTERM) calls `stop` on a thread of its own, where it may
// do anything; the next one ends the program. Make it before any other thread is started.
class StopSignals {
 public:
  explicit StopSignals(std::function<void()> stop);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace gait
