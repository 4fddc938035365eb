// Ctrl-C during long work: asks it to stop in good order. A second one ends the program at once.
#pragma once

#include "gait/cancel.h"
#include "gait/error.h"
#include "gait/platform/stop_signals.h"

namespace gait::tool {

// While it lives, Ctrl-C requests a stop. Make it before any thread is started.
class Interrupt {
 public:
  const Cancel& cancel() const { return cancel_; }
  bool requested() const { return cancel_.requested(); }
  // Throws Error("cancelled") when a stop was requested.
  void check() const {
    if (requested()) throw Error("cancelled");
  }

 private:
  Cancel cancel_;
  StopSignals signals_{[this] { cancel_.request(); }};
};

}  // namespace gait::tool
