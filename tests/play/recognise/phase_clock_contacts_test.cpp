// Contacts go in from foot switches and taps, and come out of the clock's ramp.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "gait/play/recognise/phase_clock.h"
#include "play/recognise/phase_stage.h"

namespace gait {
namespace {

using testing::expect_right_and_left_in_turn;
using testing::KnownWalk;
using testing::play;
using testing::rms_error;
using testing::StageEvent;
using testing::StageRecord;
using testing::true_contacts;

TEST(PhaseClockContacts, contacts_are_heard_at_the_sample_where_the_ramp_crosses) {
  PhaseClock clock;
  clock.set_walking(true);
  clock.set_cadence(2.21);
  std::vector<float> block(4800);
  float before = 0;
  int contacts = 0;
  for (int i = 0; i < 50; ++i) {
    clock.process(block, 48000);
    std::size_t next = 0;
    for (std::size_t sample = 0; sample < block.size(); ++sample) {
      const int step = block[sample] < before ? 0 : block[sample] >= 0.5f && before < 0.5f ? 1 : -1;
      if (step >= 0) {
        ASSERT_LT(next, clock.crossings().size());
        EXPECT_EQ(clock.crossings()[next].step, step);
        // Float shows the ramp with 24 bits only: a sample to either side.
        EXPECT_NEAR(clock.crossings()[next].sample, static_cast<double>(sample), 1);
        ++next, ++contacts;
      }
      before = block[sample];
    }
    EXPECT_EQ(next, clock.crossings().size());
  }
  EXPECT_EQ(contacts, 11);
}

TEST(PhaseClockContacts, who_waits_for_a_walker_begins_with_his_first_contact) {
  PhaseClock clock;
  std::vector<StageEvent> events = {{0, [](PhaseClock& c) { c.set_walking(false); }},
                                    {3, [](PhaseClock& c) { c.set_walking(true); }},
                                    {3, [](PhaseClock& c) { c.observe_contact(1); }}};
  const StageRecord record = play(clock, events, 3.2);
  ASSERT_EQ(record.contacts.size(), 1u);
  EXPECT_EQ(record.contacts[0].step, 1);
  EXPECT_NEAR(record.contacts[0].time, 3, 0.002);
}

// Foot switches: contacts of both feet, `jitter` seconds off at most.
std::vector<StageEvent> switches(const KnownWalk& walk, double begin, double end, double jitter) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> off(-jitter, jitter);
  std::vector<StageEvent> events;
  for (const auto& contact : true_contacts(walk, begin, end))
    events.push_back({contact.time + off(random),
                      [step = contact.step](PhaseClock& c) { c.observe_contact(step); }});
  return events;
}

TEST(PhaseClockContacts, runs_on_foot_switches_alone) {
  for (const double frequency : {0.4, 0.6, 0.9, 1.3}) {
    const KnownWalk walk({{0, frequency}, {8, 1.2 * frequency}});
    PhaseClock clock;
    const StageRecord record = play(clock, switches(walk, 0, 16, 0.01), 16);
    EXPECT_LE(rms_error(record, walk, 3 / frequency, 8), 0.03) << frequency;
    EXPECT_LE(rms_error(record, walk, 8 + 2 / frequency, 16), 0.03) << frequency;
  }
}

TEST(PhaseClockContacts, a_switch_that_bounces_is_one_contact) {
  const KnownWalk walk({{0, 0.9}});
  auto events = switches(walk, 0, 10, 0);
  for (const auto& contact : true_contacts(walk, 0, 10))
    for (const double bounce : {0.004, 0.011, 0.03})
      events.push_back({contact.time + bounce,
                        [step = contact.step](PhaseClock& c) { c.observe_contact(step); }});
  PhaseClock clock;
  const StageRecord record = play(clock, events, 10);
  EXPECT_LE(rms_error(record, walk, 3, 10), 0.03);
}

TEST(PhaseClockContacts, takes_its_tempo_from_taps) {
  for (const double cadence : {0.8, 1.5, 2.4, 4.0}) {
    PhaseClock clock;
    std::vector<StageEvent> taps;
    for (int i = 0; i < 8; ++i) taps.push_back({1 + i / cadence, [](PhaseClock& c) { c.tap(); }});
    const double end = 1 + 8 / cadence + 2;
    const StageRecord record = play(clock, taps, end);
    EXPECT_NEAR(clock.cadence(), cadence, 0.03 * cadence);
    // After the last tap, it beats where the next ones would have been.
    int beats = 0;
    for (const auto& contact : record.contacts) {
      if (contact.time < 1 + 7.5 / cadence) continue;
      const double in_beats = (contact.time - 1) * cadence;
      EXPECT_NEAR(in_beats, std::round(in_beats), 0.1) << cadence << " at " << contact.time;
      ++beats;
    }
    EXPECT_GE(beats, static_cast<int>(2 * cadence) - 1);
    expect_right_and_left_in_turn(record);
  }
}

}  // namespace
}  // namespace gait
