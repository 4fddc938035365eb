#include "gait/platform/stop_signals.h"

#include <pthread.h>

#include <atomic>
#include <csignal>
#include <thread>
#include <utility>

namespace gait {

// A signal handler may hardly do anything; a thread that waits for the signals may do all.
struct StopSignals::Inside {
  explicit Inside(std::function<void()> wanted) : stop(std::move(wanted)) {
    sigemptyset(&waited_for);
    sigaddset(&waited_for, SIGINT);
    sigaddset(&waited_for, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &waited_for, &before);
    waiter = std::thread([this] { wait(); });
  }
  ~Inside() {
    enough = true;
    pthread_kill(waiter.native_handle(), SIGTERM);  // seen by this thread alone
    waiter.join();
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

  void wait() {
    for (bool first = true;; first = false) {
      int signal = 0;
      if (sigwait(&waited_for, &signal) != 0 || enough) return;
      if (first) {
        stop();
        continue;
      }
      std::signal(signal, SIG_DFL);
      pthread_sigmask(SIG_UNBLOCK, &waited_for, nullptr);
      std::raise(signal);
    }
  }

  std::function<void()> stop;
  sigset_t waited_for{}, before{};
  std::atomic<bool> enough{false};  // the signals are waited for no longer
  std::thread waiter;
};

StopSignals::StopSignals(std::function<void()> stop)
    : inside_(std::make_unique<Inside>(std::move(stop))) {}

StopSignals::~StopSignals() = default;

}  // namespace gait
