#include "gait/play/recognise/phase_clock.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gait/error.h"

namespace gait {

namespace {

constexpr double slowest_ramp = 0.2, fastest_ramp = 2;  // of the loop's frequency
constexpr double catch_up = 0.05;                       // seconds in which the ramp closes a gap
constexpr double come_to_rest = 0.05;                   // seconds, time constant of stopping
constexpr double at_rest = 1e-3;          // share of the frequency that counts as zero
constexpr double believed = 3;            // deviations beyond which an estimate counts as if nearer
constexpr double phase_doubt = 0.3;       // deviations at a beginning: cycles
constexpr double frequency_doubt = 0.25;  // and share of the frequency
constexpr double other_tempo = 1.5;       // ratio of a step's to the loop's; a limp is none
constexpr double longest_move = 0.002;    // seconds at once
constexpr double longest_of_frame = 0.01;  // seconds at once where frames advance the clock,
constexpr int parts_of_frame = 5;          // computed as so many
// The largest float below one: rounding must not show the next cycle early.
constexpr float below_one = 0x1.fffffep-1f;
constexpr double longest_advance = 60;  // seconds; who was away longer has lost the walk anyway

double square(double x) noexcept { return x * x; }

// The nearest of all phases that mean the same, -0.5 to 0.5.
double around(double difference) noexcept { return difference - std::round(difference); }

void expect_positive(double value, const char* name) {
  if (!std::isfinite(value) || value <= 0)
    throw Error(std::string("phase clock: expected a positive ") + name + ", found " +
                std::to_string(value));
}

}  // namespace

PhaseClock::PhaseClock(const PhaseClockSettings& settings) : settings_(settings) {
  if (settings.steps < 1 || settings.steps > 64)
    throw Error("phase clock: expected 1 to 64 steps in a cycle, found " +
                std::to_string(settings.steps));
  expect_positive(settings.cadence, "cadence");
  expect_positive(settings.slowest, "slowest frequency");
  expect_positive(settings.fastest - settings.slowest, "range of frequencies");
  expect_positive(settings.noise, "noise");
  expect_positive(settings.contact_noise, "noise of contacts");
  expect_positive(settings.wander, "wander");
  reset();
}

void PhaseClock::reset() noexcept {
  moved_ = walking_ = false;
  waiting_ = true;
  going_ = 0;
  lead_ = ramp_ = time_ = 0;
  next_step_ = 1;
  contact_time_ = -1;
  crossing_count_ = 0;
  set_cadence(settings_.cadence);
  doubt();
}

// As little is known of the phase as at a beginning; the frequency is still the best guess.
void PhaseClock::doubt() noexcept {
  phase_variance_ = square(phase_doubt);
  forget_frequency();
}

// The loop goes on from where it is now, at a frequency that is a guess.
void PhaseClock::forget_frequency() noexcept {
  loop_phase_ = ramp_ + lead_;
  loop_time_ = time_;
  covariance_ = 0;
  frequency_variance_ = square(frequency_doubt * frequency_);
}

void PhaseClock::set_cadence(double cadence) noexcept {
  if (!std::isfinite(cadence)) return;
  frequency_ = std::clamp(cadence / settings_.steps, settings_.slowest, settings_.fastest);
  forget_frequency();
}

void PhaseClock::set_pull(double pull) noexcept {
  if (std::isfinite(pull)) pull_ = std::clamp(pull, 0.0, 10.0);
}

void PhaseClock::set_walking(bool walking) noexcept {
  waiting_ = false;
  if (walking == walking_) return;
  walking_ = walking;
  if (!moved_) going_ = walking;
  lead_ = 0;
  contact_time_ = -1;
  doubt();
}

void PhaseClock::take_over(const PhaseClock& other) noexcept {
  reset();
  if (other.waiting_) return;
  set_walking(true);
  observe(other.phase());
  set_walking(other.walking_);
}

// Whether what is observed counts: while standing it does not, unless nobody has walked yet.
bool PhaseClock::hears() noexcept {
  if (waiting_ && pull_ > 0) set_walking(true);
  return walking_ && pull_ > 0;
}

// Kalman's prediction for d phase = frequency dt, d frequency = white noise.
void PhaseClock::predict(double until) noexcept {
  const double dt = until - loop_time_;
  if (dt <= 0) return;
  loop_time_ = until;
  loop_phase_ += dt * frequency_;
  const double q = square(settings_.wander * pull_ * frequency_) * frequency_;
  phase_variance_ += dt * (2 * covariance_ + dt * (frequency_variance_ + dt * q / 3));
  covariance_ += dt * (frequency_variance_ + dt * q / 2);
  frequency_variance_ += dt * q;
  // After a long silence as little is known as at a beginning, not less.
  if (phase_variance_ > square(phase_doubt) ||
      frequency_variance_ > square(frequency_doubt * frequency_)) {
    const double phase = std::min(1.0, square(phase_doubt) / phase_variance_);
    const double frequency =
        std::min(1.0, square(frequency_doubt * frequency_) / frequency_variance_);
    phase_variance_ *= phase;
    frequency_variance_ *= frequency;
    covariance_ *= std::sqrt(phase * frequency);
  }
}

void PhaseClock::correct(double phase, double deviation, double late) noexcept {
  if (!moved_) {
    // Nothing has been heard yet: the ramp begins where the walk is.
    ramp_ = phase + frequency_ * late;
    ramp_ -= std::floor(ramp_);
    if (ramp_ >= 1) ramp_ = 0;
    next_step_ = static_cast<int>(ramp_ * settings_.steps) + 1;
    lead_ = 0;
    doubt();  // a first estimate is often a guess
    return;
  }
  const double then = time_ - late;
  predict(then);
  const double difference = around(phase - (loop_phase_ - (loop_time_ - then) * frequency_));
  const double variance = phase_variance_ + square(deviation);
  const double limit = believed * std::sqrt(variance);
  const double error = std::clamp(difference, -limit, limit);
  const double phase_gain = phase_variance_ / variance;
  const double frequency_gain = covariance_ / variance;
  loop_phase_ += phase_gain * error;
  frequency_ =
      std::clamp(frequency_ + frequency_gain * error, settings_.slowest, settings_.fastest);
  frequency_variance_ -= frequency_gain * covariance_;
  covariance_ *= 1 - phase_gain;
  phase_variance_ *= 1 - phase_gain;
  lead_ = around(loop_phase_ + (time_ - loop_time_) * frequency_ - ramp_);
  loop_phase_ -= std::floor(loop_phase_);
}

void PhaseClock::observe(double phase, double weight, double late) noexcept {
  if (!std::isfinite(phase) || !std::isfinite(late) || !(weight > 0) || !hears()) return;
  correct(phase, settings_.noise / (pull_ * std::sqrt(std::min(weight, 1.0))), std::max(0.0, late));
}

void PhaseClock::observe_contact(int step, double late) noexcept {
  if (step < 0 || step >= settings_.steps || !std::isfinite(late)) return;
  touch(static_cast<double>(step) / settings_.steps, std::max(0.0, late));
}

void PhaseClock::tap() noexcept {
  const double step = 1.0 / settings_.steps;
  // The first of a row of taps means the nearest step, each other the step after the last.
  const bool goes_on = contact_time_ >= 0 && (time_ - contact_time_) * settings_.slowest < step;
  const double phase = goes_on ? contact_phase_ + step : std::round((ramp_ + lead_) / step) * step;
  touch(phase - std::floor(phase), 0);
}

void PhaseClock::touch(double phase, double late) noexcept {
  if (!hears()) return;
  const double time = time_ - late;
  if (contact_time_ >= 0) {
    double travelled = phase - contact_phase_;
    travelled -= std::ceil(travelled) - 1;  // more than 0, up to 1
    const double frequency = travelled / (time - contact_time_);
    if (!(time > contact_time_) || frequency > settings_.fastest) return;
    if (frequency > settings_.slowest &&
        std::max(frequency / frequency_, frequency_ / frequency) > other_tempo) {
      // Another tempo altogether: what was known of the phase led elsewhere.
      frequency_ = frequency;
      doubt();
    }
  }
  contact_time_ = time;
  contact_phase_ = phase;
  // A hair before it, so that it is heard also when the ramp begins here.
  correct(phase - 1e-9, settings_.contact_noise / pull_, late);
}

// A sample after the other, a gap would shrink by 1/catch_up of itself a second, and what going_
// lacks by 1/come_to_rest: a pace says what is left of both after all samples.
PhaseClock::Pace PhaseClock::pace_of(int samples, double period) noexcept {
  const double count = samples;
  Pace pace{.seconds = count * period, .samples = samples, .period = period};
  const double closed = 1 - std::pow(1 - std::min(1.0, period / catch_up), count);
  pace.catch_up = samples == 1 ? std::max(catch_up, period) : pace.seconds / closed;
  const double share = std::min(1.0, period / come_to_rest);
  pace.kept = std::pow(1 - share, count);
  pace.kept_mean = (1 - share) * (1 - pace.kept) / (count * share);
  return pace;
}

double PhaseClock::move(const Pace& pace) noexcept {
  time_ += pace.seconds;
  const double goal = walking_ ? 1 : 0, lacking = going_ - goal;
  if (!walking_ && going_ == 0) return 0;
  going_ = goal + lacking * pace.kept;
  double going = goal + lacking * pace.kept_mean;
  if (!walking_ && going_ < at_rest) going_ = going = 0;
  const double speed = going * std::clamp(frequency_ + lead_ / pace.catch_up,
                                          slowest_ramp * frequency_, fastest_ramp * frequency_);
  moved_ = moved_ || speed > 0;
  if (walking_) lead_ += (frequency_ - speed) * pace.seconds;
  return speed * pace.seconds;
}

// Adds `way` to the ramp in `samples` equal parts, which are written to `phase` unless it is null;
// `first`: the sample of the block with which they begin.
template <typename Sample>
void PhaseClock::pass(Sample* phase, int first, int samples, double way) noexcept {
  const double part = way / samples;
  double from = ramp_;
  int written = 0;
  const auto write = [&](int end) noexcept {
    const int begin = written;
    written = end;
    if (!phase || begin == end) return;
    const double start = from;
    for (int i = begin; i < end; ++i) phase[i] = static_cast<Sample>(start + part * (i + 1));
    // Rounding at a cycle's ends.
    phase[begin] = std::max(phase[begin], Sample(0));
    for (int i = end - 1; i >= begin && phase[i] > below_one; --i) phase[i] = below_one;
  };
  ramp_ += way;
  while (ramp_ * settings_.steps >= next_step_) {
    const double edge = static_cast<double>(next_step_) / settings_.steps;
    const double parts = part > 0 ? std::ceil((edge - from) / part) : 1;
    const int sample = static_cast<int>(std::clamp(parts - 1, 0.0, samples - 1.0));
    if (next_step_ == settings_.steps) {
      write(sample);
      ramp_ = std::max(0.0, ramp_ - 1);
      from -= 1;
      next_step_ = 0;
    }
    if (crossing_count_ < static_cast<int>(crossings_.size()))
      crossings_[static_cast<std::size_t>(crossing_count_++)] = {first + sample, next_step_};
    ++next_step_;
  }
  write(samples);
}

template <typename Sample>
void PhaseClock::run(Sample* phase, int samples, double sample_rate) noexcept {
  crossing_count_ = 0;
  if (!(sample_rate > 0)) {
    if (phase) std::fill_n(phase, samples, static_cast<Sample>(this->phase()));
    return;
  }
  const double period = 1 / sample_rate;
  const int longest = std::max(1, static_cast<int>(longest_move * sample_rate));
  for (int done = 0; done < samples; done += longest) {
    const int count = std::min(longest, samples - done);
    if (count != pace_.samples || period != pace_.period) pace_ = pace_of(count, period);
    pass(phase ? phase + done : phase, done, count, move(pace_));
  }
}

void PhaseClock::process(std::span<float> phase, double sample_rate) noexcept {
  run(phase.data(), static_cast<int>(phase.size()), sample_rate);
}

void PhaseClock::process(std::span<double> phase, double sample_rate) noexcept {
  run(phase.data(), static_cast<int>(phase.size()), sample_rate);
}

void PhaseClock::process(int samples, double sample_rate) noexcept {
  run(static_cast<float*>(nullptr), samples, sample_rate);
}

void PhaseClock::advance(double seconds) noexcept {
  crossing_count_ = 0;
  if (!(seconds > 0) || !std::isfinite(seconds)) return;
  const double whole = std::min(seconds, longest_advance);
  const int moves = static_cast<int>(std::ceil(whole / longest_of_frame));
  const double period = whole / moves / parts_of_frame;
  if (pace_.samples != parts_of_frame || period != pace_.period)
    pace_ = pace_of(parts_of_frame, period);
  for (int i = 0; i < moves; ++i) pass(static_cast<float*>(nullptr), 0, 1, move(pace_));
}

float PhaseClock::phase() const noexcept { return std::min(static_cast<float>(ramp_), below_one); }

float PhaseClock::cadence() const noexcept {
  return static_cast<float>(going_ * frequency_ * settings_.steps);
}

}  // namespace gait
