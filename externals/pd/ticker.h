// One of Pd's clocks with a C++ function behind it, on Pd's main thread.
#pragma once

#include <m_pd.h>

#include <functional>

namespace gait::pd {

class Ticker {
 public:
  explicit Ticker(std::function<void()> tick)
      : tick_(std::move(tick)), clock_(clock_new(this, reinterpret_cast<t_method>(&call))) {}
  ~Ticker() { clock_free(clock_); }
  Ticker(const Ticker&) = delete;
  Ticker& operator=(const Ticker&) = delete;

  void after(double milliseconds) { clock_delay(clock_, milliseconds); }
  void cancel() { clock_unset(clock_); }

 private:
  static void call(Ticker* self) { self->tick_(); }

  std::function<void()> tick_;
  t_clock* clock_;
};

// Ticks again and again while it runs, in logical time: it never drifts.
class Metronome {
 public:
  explicit Metronome(std::function<void()> tick)
      : tick_(std::move(tick)), ticker_([this] {
          ticker_.after(period_);
          tick_();
        }) {}

  // The first tick comes at once.
  void start(double milliseconds) {
    period_ = milliseconds;
    running_ = true;
    ticker_.after(0);
  }
  void stop() {
    running_ = false;
    ticker_.cancel();
  }
  void set_period(double milliseconds) { period_ = milliseconds; }
  bool running() const { return running_; }

 private:
  double period_ = 20;  // ms
  bool running_ = false;
  std::function<void()> tick_;
  Ticker ticker_;
};

}  // namespace gait::pd
