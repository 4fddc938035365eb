// Ctrl-C during long work: asks it to stop in good order. A second one ends the program at once.
#pragma once

#include <atomic>
#include <csignal>

#include "gait/cancel.h"
#include "gait/joining_thread.h"

namespace gait::tool {

// While it lives, SIGINT and SIGTERM request a stop. Make it before any thread is started.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  const Cancel& cancel() const { return cancel_; }
  bool requested() const { return cancel_.requested(); }
  // Throws Error("cancelled") when a stop was requested.
  void check() const;

 private:
  sigset_t waited_for_{}, before_{};
  Cancel cancel_;
  std::atomic<bool> enough_{false};  // the signals are waited for no longer
  JoiningThread waiter_;
};

}  // namespace gait::tool
