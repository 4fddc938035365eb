// Frames taken from signals: one number per channel, at the model's rate, from signal inlets or
// from one multichannel inlet.
//
// The audio side only copies numbers into a ring; a clock then has Pd's scheduler take them out
// with their times. Both run on one thread, one after the other. Nothing allocates while DSP runs.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "pd/box.h"
#include "pd/ticker.h"

namespace gait::pd {

class SignalInput {
 public:
  // `frame`: called on Pd's thread, outside DSP, for each frame with its time (s, from the first
  // sample on).
  SignalInput(Box& box, std::function<void(double time, std::span<const float> values)> frame)
      : box_(box), frame_(std::move(frame)) {}

  // Makes the inlets; none without this. make_multichannel throws Error on a Pd without them.
  void make_inlets(int count);
  void make_multichannel();
  int inlets() const { return multichannel_ ? 1 : inlets_; }

  void set_rate(double frames_per_second) { rate_ = frames_per_second; }
  // From the box's dsp method, before anything that writes the outlets' signals: they may lie where
  // the inlets' are.
  void dsp(t_signal** signals);

 private:
  static t_int* perform(t_int* w);
  void take(int count) noexcept;
  void tell();

  static constexpr int most_waiting = 64;  // frames; more in one block are dropped
  Box& box_;
  std::function<void(double, std::span<const float>)> frame_;
  int inlets_ = 0;
  bool multichannel_ = false;
  double rate_ = 30, sample_rate_ = 48000;
  double time_ = 0, next_ = 0;  // s since the first sample
  std::vector<const t_sample*> channels_;
  int waiting_ = 0;
  std::vector<float> ring_, told_;
  std::vector<double> times_;
  Ticker ticker_{[this] { tell(); }};
};

}  // namespace gait::pd
