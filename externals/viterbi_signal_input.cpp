#include "viterbi_signal_input.h"

#include <algorithm>
#include <utility>

#include "gait/error.h"
#include "pd/multichannel.h"

namespace gait::pd {

void SignalInput::make_inlets(int count) {
  inlets_ = count;
  for (int i = 0; i < count; ++i)
    inlet_new(&box_.object, box_.pd(), gensym("signal"), gensym("signal"));
}

void SignalInput::make_multichannel() {
  if (!has_multichannel())
    throw Error(std::string(box_.name()) +
                ": -mc: expected Pd 0.54 or later, this one has no multichannel signals");
  make_inlets(1);
  multichannel_ = true;
}

void SignalInput::dsp(t_signal** signals) {
  if (inlets() == 0) return;
  const int channels = multichannel_ ? channels_of(signals[0]) : inlets_;
  const int count = signals[0]->s_n;
  channels_.clear();
  for (int i = 0; i < channels; ++i)
    channels_.push_back(multichannel_ ? signals[0]->s_vec + i * count : signals[i]->s_vec);
  waiting_ = 0;
  ring_.assign(static_cast<std::size_t>(most_waiting * channels), 0);
  told_.assign(static_cast<std::size_t>(channels), 0);
  times_.assign(most_waiting, 0);
  sample_rate_ = signals[0]->s_sr;
  dsp_add(&perform, 2, this, static_cast<t_int>(count));
}

t_int* SignalInput::perform(t_int* w) {
  reinterpret_cast<SignalInput*>(w[1])->take(static_cast<int>(w[2]));
  return w + 3;
}

void SignalInput::take(int count) noexcept {
  const double end = time_ + count / sample_rate_;
  const auto channels = static_cast<std::ptrdiff_t>(channels_.size());
  for (; next_ < end; next_ += 1 / rate_) {
    if (waiting_ >= most_waiting) continue;
    const int sample = std::clamp(static_cast<int>((next_ - time_) * sample_rate_), 0, count - 1);
    for (std::ptrdiff_t i = 0; i < channels; ++i)
      ring_[static_cast<std::size_t>(waiting_ * channels + i)] =
          static_cast<float>(channels_[static_cast<std::size_t>(i)][sample]);
    times_[static_cast<std::size_t>(waiting_++)] = next_;
  }
  time_ = end;
  if (waiting_ > 0) ticker_.after(0);
}

void SignalInput::tell() {
  const int waiting = std::exchange(waiting_, 0);
  const auto channels = static_cast<std::ptrdiff_t>(told_.size());
  for (int i = 0; i < waiting; ++i) {
    std::copy_n(ring_.begin() + i * channels, channels, told_.begin());
    frame_(times_[static_cast<std::size_t>(i)], told_);
  }
}

}  // namespace gait::pd
