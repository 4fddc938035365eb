#include "interrupt.h"

#include <pthread.h>

#include <ctime>

#include "gait/error.h"

namespace gait::tool {

Interrupt::Interrupt() {
  sigemptyset(&waited_for_);
  sigaddset(&waited_for_, SIGINT);
  sigaddset(&waited_for_, SIGTERM);
  // A signal handler may hardly do anything; a thread that waits for the signals may do all.
  pthread_sigmask(SIG_BLOCK, &waited_for_, &before_);
  waiter_ = JoiningThread([this] {
    const timespec while_waiting{0, 50'000'000};
    while (!enough_) {
      const int signal = sigtimedwait(&waited_for_, nullptr, &while_waiting);
      if (signal < 0) continue;
      if (cancel_.requested()) {
        std::signal(signal, SIG_DFL);
        pthread_sigmask(SIG_UNBLOCK, &waited_for_, nullptr);
        std::raise(signal);
      }
      cancel_.request();
    }
  });
}

Interrupt::~Interrupt() {
  enough_ = true;
  waiter_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void Interrupt::check() const {
  if (cancel_.requested()) throw Error("cancelled");
}

}  // namespace gait::tool
