// Phase clock: a ramp at audio rate from a few noisy phase estimates a second.
//
// A second-order phase-locked loop with two layers. The loop itself, phase and frequency, takes
// each estimate with the gains of a Kalman filter whose frequency wanders: fast at first, then as
// slow as the estimates' noise asks for, right for irregular and lost estimates too. The ramp that
// is heard follows the loop at 0.2 to 2 times its frequency, so it never jumps and never runs
// backwards, and meets each contact once a cycle. It stands until somebody walks: the first
// estimate, contact or tap starts it where that says; when estimates cease, it goes on by itself.
//
// Phase in cycles, 0 to 1, where step i of the cycle begins at i / steps (right contact 0, left
// 0.5); frequency in cycles per second, cadence in steps per second. Never allocates.
#pragma once

#include <array>
#include <span>

namespace gait {

struct PhaseClockSettings {
  int steps = 2;                 // in a cycle, 1 to 64
  double cadence = 1.8;          // steps/s to begin with
  double slowest = 0.1;          // cycles/s, limits of the frequency
  double fastest = 4;            // cycles/s
  double noise = 0.04;           // deviation of an estimate, cycles
  double contact_noise = 0.012;  // deviation of a contact, cycles
  double wander = 0.2;           // share by which frequency changes over one cycle
};

class PhaseClock {
 public:
  // Throws Error when a setting is out of its range or not positive.
  explicit PhaseClock(const PhaseClockSettings& settings = {});

  // An estimate of the phase `late` seconds ago; `weight` 0 to 1 says how sure it is. One that is
  // not finite changes nothing, nor does any while standing.
  void observe(double phase, double weight = 1, double late = 0) noexcept;
  // The foot that begins step `step` of the cycle touches: 0 right, 1 left. Far surer than an
  // estimate; contacts alone are enough to run on. One too soon after another to be a step (a
  // switch that bounces) changes nothing.
  void observe_contact(int step, double late = 0) noexcept;
  // Somebody taps the beat: a contact of whichever foot is next.
  void tap() noexcept;

  // Steps/s from now on, until estimates say otherwise. Held within slowest and fastest. It starts
  // nothing.
  void set_cadence(double cadence) noexcept;
  // Not walking: the frequency falls to zero and the phase stands, whatever is observed. Walking
  // again: on from there.
  void set_walking(bool walking) noexcept;
  // Runs so many seconds ahead of the walk, 0 to 1: phase and contacts come early, to make up for
  // what sound and network take. It changes without a jump.
  void set_ahead(double seconds) noexcept;
  double ahead() const noexcept { return ahead_; }
  // How hard estimates pull: 1 as tuned, 2 follows twice as fast, 0 not at all. At most 10.
  void set_pull(double pull) noexcept;

  // A crossing into a step: the contact of the foot that begins it.
  struct Crossing {
    int sample = 0;  // of the block
    int step = 0;    // 0 right, 1 left
  };

  // Goes on as another clock (of another model) did: at its phase, as far ahead, and standing or
  // waiting for a first estimate where that one does.
  void take_over(const PhaseClock& other) noexcept;

  // Moves on by a block of audio and fills it with the phase, a line for 2 ms at once.
  void process(std::span<float> phase, double sample_rate) noexcept;
  void process(std::span<double> phase, double sample_rate) noexcept;
  // The same where no phase is heard.
  void process(int samples, double sample_rate) noexcept;
  // Moves on by `seconds` (60 at most) without sound; crossings are then all at sample 0.
  void advance(double seconds) noexcept;
  // Those of the last process or advance, in order.
  std::span<const Crossing> crossings() const noexcept {
    return {crossings_.data(), static_cast<std::size_t>(crossing_count_)};
  }

  float phase() const noexcept;  // of the ramp, 0 to 1 with 1 left out
  float cadence() const noexcept;
  double frequency() const noexcept { return going_ * frequency_; }  // cycles per second
  bool walking() const noexcept { return walking_; }
  // As at the beginning: standing until somebody walks.
  void reset() noexcept;

 private:
  // How a number of samples in a row move the ramp.
  struct Pace {
    double seconds = 0;
    double catch_up = 1;             // seconds in which the ramp would close the gap
    double kept = 1, kept_mean = 1;  // of what `going_` lacks: at the end, and on average
    int samples = 0;
    double period = 0;  // of a sample, seconds
  };
  static Pace pace_of(int samples, double period) noexcept;
  double move(const Pace& pace) noexcept;  // says the way in cycles
  template <typename Sample>
  void run(Sample* phase, int samples, double sample_rate) noexcept;
  template <typename Sample>
  void pass(Sample* phase, int first, int samples, double way) noexcept;
  bool hears() noexcept;
  void predict(double until) noexcept;
  void correct(double phase, double deviation, double late) noexcept;
  void touch(double phase, double late) noexcept;
  void doubt() noexcept;
  void forget_frequency() noexcept;

  PhaseClockSettings settings_;
  double pull_ = 1, ahead_ = 0;
  bool walking_ = false, moved_ = false;
  bool waiting_ = true;  // nobody has walked yet: the first estimate starts it

  // The loop: where it was at the moment the last estimate spoke of, from where it runs at its
  // frequency. Now it is `lead_` ahead of the ramp.
  double loop_phase_ = 0, loop_time_ = 0, frequency_ = 1, lead_ = 0;
  double phase_variance_ = 0, covariance_ = 0, frequency_variance_ = 0;

  // The ramp.
  double ramp_ = 0;
  double going_ = 0;  // 0 standing, 1 walking, and between for a moment
  int next_step_ = 1;
  Pace pace_;  // of the block before: blocks mostly are as long

  double time_ = 0;  // seconds since reset
  double contact_time_ = -1, contact_phase_ = 0;
  std::array<Crossing, 64> crossings_;
  int crossing_count_ = 0;
};

}  // namespace gait
