#include "pd/phase_signals.h"

#include <algorithm>

// Pd's own, of m_imp.h, the same since 0.37: the first cord of an outlet, or null.
extern "C" {
EXTERN t_outconnect* obj_starttraverseoutlet(const t_object*, t_outlet**, int number);
}

namespace gait::pd {

PhaseSignals::PhaseSignals(Box& box, std::function<void(int)> contact)
    : box_(box), contact_(std::move(contact)) {
  for (int i = 0; i < outlets; ++i) outlet_new(&box.object, gensym("signal"));
}

void PhaseSignals::replace(const PhaseClockSettings& settings) {
  PhaseClock fresh(settings);
  fresh.take_over(clock_);
  clock_ = fresh;
}

// Pd calls this again whenever a cord of signals comes or goes; a signal without cords is not
// written.
void PhaseSignals::dsp(t_signal** signals, int first) {
  for (int i = 0; i < outlets; ++i) {
    t_outlet* outlet = nullptr;
    const bool heard = obj_starttraverseoutlet(&box_.object, &outlet, i) != nullptr;
    out_[static_cast<std::size_t>(i)] = heard ? signals[first + i]->s_vec : nullptr;
  }
  sample_rate_ = signals[first]->s_sr;
  dsp_add(&perform, 2, this, static_cast<t_int>(signals[first]->s_n));
}

t_int* PhaseSignals::perform(t_int* w) {
  reinterpret_cast<PhaseSignals*>(w[1])->fill(static_cast<int>(w[2]));
  return w + 3;
}

void PhaseSignals::fill(int count) noexcept {
  const auto begin = std::chrono::steady_clock::now();
  const auto [phase, cadence, right, left] = out_;
  for (t_sample* const contacts : {right, left})
    if (contacts) std::fill_n(contacts, count, t_sample(0));
  if (phase)
    clock_.process(std::span(phase, static_cast<std::size_t>(count)), sample_rate_);
  else
    clock_.process(count, sample_rate_);
  for (const PhaseClock::Crossing& crossing : clock_.crossings()) {
    if (t_sample* const contacts = crossing.step % 2 == 0 ? right : left)
      contacts[crossing.sample] = 1;
    if (count_ < static_cast<int>(steps_.size()))
      steps_[static_cast<std::size_t>(count_++)] = crossing.step;
  }
  if (cadence) std::fill_n(cadence, count, t_sample(clock_.cadence()));
  if (count_ > 0) ticker_.after(0);
  moved_ = clock_getlogicaltime();
  silent_ = false;
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
  microseconds_ += took.count();
  most_ = std::max(most_, took.count());
  ++blocks_;
}

void PhaseSignals::tell() {
  const auto steps = steps_;
  const int count = count_;
  count_ = 0;
  for (int i = 0; i < count; ++i) contact_(steps[static_cast<std::size_t>(i)]);
}

void PhaseSignals::keep_going() {
  constexpr double longest_block = 0.25;  // seconds; after that DSP is off
  const double passed = clock_gettimesince(moved_) / 1000;
  if (!silent_ && passed < longest_block) return;
  silent_ = true;
  moved_ = clock_getlogicaltime();
  clock_.advance(passed);
  for (const PhaseClock::Crossing& crossing : clock_.crossings()) contact_(crossing.step);
}

void PhaseSignals::report(Outlet& info) {
  info.add(blocks_ > 0 ? microseconds_ / blocks_ : 0).add(most_).add(blocks_).add(0).send("perf");
  microseconds_ = most_ = 0;
  blocks_ = 0;
}

}  // namespace gait::pd
