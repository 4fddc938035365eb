// A phase clock as four signal outlets, for [gait.viterbi~] and [gait.phase~].
//
//   phase~     0 to 1, a ramp per cycle     right~, left~   one sample of 1 where that foot touches
//   cadence~   steps per second
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <optional>

#include "gait/play/recognise/phase_clock.h"
#include "pd/outlet.h"
#include "pd/ticker.h"

namespace gait::pd {

class PhaseSignals {
 public:
  static constexpr int outlets = 4;

  // Makes the outlets. `contact`: called on Pd's thread, outside DSP, for each contact with the
  // step that begins (0 right, 1 left).
  PhaseSignals(Box& box, std::function<void(int step)> contact);

  PhaseClock& clock() { return clock_; }
  // Changes to another model's clock, which goes on as the one before did.
  void replace(const PhaseClockSettings& settings);

  // To be called with every frame: while no DSP runs, this advances the clock by the time passed,
  // so that contacts go out without DSP too.
  void keep_going();

  // From the box's dsp method; `first`: index of phase~ among the signals.
  void dsp(t_signal** signals, int first = 0);

  // `perf MEAN_US MAX_US BLOCKS 0` of the signals, since the last time.
  void report(Outlet& info);

 private:
  static t_int* perform(t_int* w);
  void fill(int count) noexcept;
  void tell();

  Box& box_;
  PhaseClock clock_;
  std::function<void(int)> contact_;
  double sample_rate_ = 48000;
  std::array<t_sample*, outlets> out_{};  // null where no cord leads away
  // Steps that began since the last call of tell(); more than fit are dropped.
  std::array<int, 64> steps_{};
  int count_ = 0;
  double moved_ = clock_getlogicaltime();  // when the clock was moved last
  bool silent_ = false;                    // no DSP runs
  double microseconds_ = 0, most_ = 0;
  int blocks_ = 0;
  Ticker ticker_{[this] { tell(); }};
};

}  // namespace gait::pd
