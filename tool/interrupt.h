// Ctrl-C during long work: asks it to stop in good order. A second one ends the program at once.
#pragma once

#include <csignal>
#include <stop_token>
#include <thread>

namespace gait::tool {

// While it lives, SIGINT and SIGTERM request a stop. Make it before any thread is started.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const { return stop_.get_token(); }
  // Throws Error("cancelled") when a stop was requested.
  void check() const;

 private:
  sigset_t waited_for_{}, before_{};
  std::stop_source stop_;
  std::jthread waiter_;
};

}  // namespace gait::tool
