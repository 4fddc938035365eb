#include "gait/play/recognise/phase_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "gait/error.h"
#include "play/recognise/phase_stage.h"

namespace gait {
namespace {

using testing::estimates_of;
using testing::expect_right_and_left_in_turn;
using testing::KnownWalk;
using testing::play;
using testing::rms_error;
using testing::Sight;
using testing::StageEvent;
using testing::StageRecord;
using testing::steepest_step;
using testing::true_contacts;

std::vector<StageEvent> operator+(std::vector<StageEvent> a, const std::vector<StageEvent>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(PhaseClock, two_cycles_after_it_began_it_is_where_the_walk_is) {
  for (const double frequency : {0.5, 0.7, 0.9, 1.1, 1.3})
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const KnownWalk walk({{0, frequency}});
      PhaseClock clock;
      const StageRecord record =
          play(clock, estimates_of(walk, 0, 12, {.noise = 0.03, .seed = seed}), 12);
      EXPECT_LE(rms_error(record, walk, 2 / frequency, 12), 0.03)
          << frequency << " Hz, seed " << seed;
      EXPECT_NEAR(clock.cadence(), 2 * frequency, 0.2 * frequency);
    }
}

TEST(PhaseClock, settles_within_two_cycles_after_cadence_changes_by_a_fifth) {
  for (const double frequency : {0.6, 0.9, 1.2})
    for (const double change : {0.8, 1.2})
      for (unsigned seed = 1; seed <= 5; ++seed) {
        const KnownWalk walk({{0, frequency}, {6, change * frequency}});
        PhaseClock clock;
        const StageRecord record =
            play(clock, estimates_of(walk, 0, 16, {.noise = 0.02, .seed = seed}), 16);
        const double settled = 6 + 2 / (change * frequency);
        EXPECT_LE(rms_error(record, walk, 2 / frequency, 6), 0.03);
        EXPECT_LE(rms_error(record, walk, 6, settled), 0.05) << "on its way";
        EXPECT_LE(rms_error(record, walk, settled, 16), 0.03)
            << frequency << " Hz times " << change << ", seed " << seed;
      }
}

TEST(PhaseClock, never_jumps_or_runs_back_when_frames_come_early_late_or_not_at_all) {
  for (const double frequency : {0.6, 0.9, 1.2})
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const KnownWalk walk({{0, frequency}});
      PhaseClock clock;
      const Sight sight{.noise = 0.02, .jitter = 0.02, .lost = 0.05, .seed = seed};
      const StageRecord record = play(clock, estimates_of(walk, 0.03, 12, sight), 12);
      const double steepest = steepest_step(record, 1 / frequency, 12);
      EXPECT_GT(steepest, 0) << "it ran backwards";
      EXPECT_LE(steepest, 3) << frequency << " Hz, seed " << seed;
      EXPECT_LE(rms_error(record, walk, 2 / frequency, 12), 0.03);
    }
}

TEST(PhaseClock, each_foot_touches_once_a_cycle_whatever_the_estimates_do) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const double frequency = 0.9;
    const KnownWalk walk({{0, frequency}});
    PhaseClock clock;
    const Sight sight{.noise = 0.04, .jitter = 0.02, .lost = 0.05, .seed = seed};
    const StageRecord record = play(clock, estimates_of(walk, 0.03, 12, sight), 12);
    expect_right_and_left_in_turn(record);
    const auto contacts = true_contacts(walk, 2 / frequency, 11.8);
    int met = 0;
    for (const auto& contact : contacts)
      for (const auto& heard : record.contacts)
        met += heard.step == contact.step && std::abs(heard.time - contact.time) < 0.15;
    EXPECT_EQ(met, static_cast<int>(contacts.size())) << "seed " << seed;
  }
}

TEST(PhaseClock, stands_still_when_the_walker_does_and_goes_on_when_he_does) {
  const double frequency = 0.9;
  const KnownWalk walk({{0, frequency}, {5.3, 0}, {9, frequency}});
  PhaseClock clock;
  // Estimates of who stands are noise; the clock must not follow them.
  const auto events = estimates_of(walk, 0, 5.3, {}) +
                      std::vector<StageEvent>{{5.3, [](PhaseClock& c) { c.set_walking(false); }}} +
                      estimates_of(KnownWalk({{0, 0.31}}), 5.4, 9, {.noise = 0.2}) +
                      std::vector<StageEvent>{{9, [](PhaseClock& c) { c.set_walking(true); }}} +
                      estimates_of(walk, 9, 16, {});
  const StageRecord record = play(clock, events, 16);
  const auto at = [&](double time) {
    return record.phase[static_cast<std::size_t>(time * testing::stage_rate)];
  };
  // It comes to rest in a third of a second, a tenth of a cycle on, and from there moves not at
  // all.
  EXPECT_NEAR(testing::wrapped_error(at(5.8), at(5.3)), 0.05, 0.05);
  for (double time = 5.8; time < 9; time += 0.01) ASSERT_EQ(at(time), at(5.8)) << time;
  for (const auto& contact : record.contacts)
    EXPECT_FALSE(contact.time > 5.8 && contact.time < 9) << contact.time;
  EXPECT_LE(rms_error(record, walk, 9 + 2 / frequency, 16), 0.02);
  expect_right_and_left_in_turn(record);
  EXPECT_GE(steepest_step(record, 1, 16), 0) << "it ran backwards";
}

TEST(PhaseClock, says_that_cadence_is_zero_while_standing) {
  PhaseClock clock;
  clock.set_walking(true);
  clock.set_cadence(2);
  clock.advance(1);
  EXPECT_NEAR(clock.cadence(), 2, 1e-6);
  clock.set_walking(false);
  clock.advance(0.5);
  EXPECT_EQ(clock.cadence(), 0);
  clock.set_walking(true);
  clock.advance(0.5);
  EXPECT_NEAR(clock.cadence(), 2, 1e-3);
}

TEST(PhaseClock, goes_on_walking_by_itself_when_the_stream_is_lost) {
  const KnownWalk walk({{0, 1.05}});
  PhaseClock clock;
  const StageRecord record = play(clock, estimates_of(walk, 0, 8, {.noise = 0.01}), 11);
  // Three seconds blind: a phase error of three seconds times what it missed of the frequency.
  EXPECT_LE(rms_error(record, walk, 8, 11), 0.08);
  EXPECT_NEAR(clock.cadence(), 2.1, 0.05);
}

TEST(PhaseClock, estimates_that_are_known_to_be_late_leave_the_ramp_on_time) {
  const double frequency = 0.9, change = 1.2;
  const KnownWalk walk({{0, frequency}, {6, change * frequency}});
  PhaseClock clock;
  const StageRecord record =
      play(clock, estimates_of(walk, 0, 14, {.noise = 0.02, .late = 0.2}), 14);
  EXPECT_LE(rms_error(record, walk, 2 / frequency, 6), 0.03);
  EXPECT_LE(rms_error(record, walk, 6.2 + 2 / (change * frequency), 14), 0.03);
  EXPECT_LE(steepest_step(record, 2, 14), 3);
}

TEST(PhaseClock, runs_so_far_ahead_of_the_walk_as_it_is_set_without_a_jump) {
  for (const double ahead : {0.05, 0.1, 0.2}) {
    const double frequency = 0.9;
    const KnownWalk walk({{0, frequency}}), sooner({{-ahead, frequency}});
    auto events = estimates_of(walk, 0, 14, {.noise = 0.01});
    events.push_back({6, [ahead](PhaseClock& clock) { clock.set_ahead(ahead); }});
    PhaseClock clock;
    const StageRecord record = play(clock, events, 14);
    EXPECT_LE(rms_error(record, walk, 3, 6), 0.02);
    EXPECT_LE(rms_error(record, sooner, 8, 14), 0.02) << ahead;
    const double steepest = steepest_step(record, 3, 14);
    EXPECT_GT(steepest, 0);
    EXPECT_LE(steepest, 3);
    PhaseClock next;
    next.take_over(clock);
    EXPECT_NEAR(next.phase(), clock.phase(), 1e-6);
    EXPECT_EQ(next.ahead(), ahead);
  }
}

TEST(PhaseClock, taps_and_contacts_are_followed_ahead_too) {
  for (const bool taps : {true, false}) {
    PhaseClock clock;
    clock.set_ahead(0.1);
    std::vector<StageEvent> events;
    for (int i = 0; i < 24; ++i)
      events.push_back(
          {0.5 * i, [taps, i](PhaseClock& to) { taps ? to.tap() : to.observe_contact(i % 2); }});
    const StageRecord record = play(clock, events, 11.9);
    expect_right_and_left_in_turn(record);
    for (const auto& contact : record.contacts) {
      if (contact.time < 5) continue;
      EXPECT_NEAR(std::remainder(contact.time + 0.1, 0.5), 0, 0.02) << contact.time;
    }
  }
}

TEST(PhaseClock, finds_the_walk_again_however_far_it_is_off_without_running_back) {
  const double frequency = 0.9;
  for (const double off : {-0.4, -0.25, 0.25, 0.4, 0.5}) {
    PhaseClock clock;
    const KnownWalk before({{0, frequency}}), after({{-off / frequency, frequency}});
    const StageRecord record =
        play(clock, estimates_of(before, 0, 6, {}) + estimates_of(after, 6, 14, {}), 14);
    EXPECT_LE(rms_error(record, before, 3, 6), 0.02);
    EXPECT_LE(rms_error(record, after, 6 + 2 / frequency, 14), 0.02) << off;
    expect_right_and_left_in_turn(record);
    const double steepest = steepest_step(record, 1, 14);
    EXPECT_GT(steepest, 0) << "it ran backwards, " << off;
    EXPECT_LE(steepest, 4) << off;  // not steady walking: it hurries to catch up
  }
}

TEST(PhaseClock, one_wild_estimate_does_not_throw_it) {
  const KnownWalk walk({{0, 0.9}});
  auto events = estimates_of(walk, 0, 8, {.noise = 0.005});
  events.push_back({6.01, [&](PhaseClock& c) { c.observe(walk.cycles(6.01) + 0.45); }});
  PhaseClock clock;
  const StageRecord record = play(clock, events, 8);
  EXPECT_LE(rms_error(record, walk, 6, 6.5), 0.02);
}

TEST(PhaseClock, pull_sets_how_fast_it_follows) {
  const KnownWalk walk({{0, 0.9}, {6, 1.08}});
  const auto error_with = [&](double pull) {
    PhaseClock clock;
    auto events = estimates_of(walk, 0, 7.5, {.noise = 0});
    events.push_back({4, [pull](PhaseClock& c) { c.set_pull(pull); }});
    return rms_error(play(clock, events, 7.5), walk, 6, 7.5);
  };
  EXPECT_LT(error_with(2), 0.7 * error_with(1));
  EXPECT_GT(error_with(0.5), 1.4 * error_with(1));
  // Not pulled at all, it walks on as it did: 0.18 Hz too slow for 1.5 s.
  EXPECT_NEAR(error_with(0), 0.27 / std::sqrt(3), 0.02);
}

TEST(PhaseClock, in_frames_it_goes_as_in_samples) {
  PhaseClock frames, samples;
  frames.set_cadence(1.9);
  samples.set_cadence(1.9);
  std::vector<float> block(1600);
  for (int i = 0; i < 90; ++i) {
    const double phase = std::fmod(0.2 + i * 0.031, 1.0);
    frames.observe(phase);
    samples.observe(phase);
    frames.advance(1 / 30.0);
    samples.process(block, 48000);
    EXPECT_NEAR(std::remainder(frames.phase() - samples.phase(), 1.0f), 0, 2e-3);
    EXPECT_EQ(frames.crossings().size(), samples.crossings().size());
  }
}

TEST(PhaseClock, nonsense_changes_nothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  PhaseClock clock, twin;
  for (int i = 0; i < 60; ++i) {
    for (PhaseClock* each : {&clock, &twin}) each->observe(std::fmod(i * 0.03, 1.0));
    clock.observe(nan);
    clock.observe(infinite);
    clock.observe(0.3, nan);
    clock.observe(0.3, -1);
    clock.observe(0.3, 1, nan);
    clock.observe_contact(2);
    clock.observe_contact(-1);
    clock.observe_contact(0, infinite);
    clock.set_cadence(nan);
    clock.set_pull(nan);
    clock.advance(nan);
    clock.advance(-1);
    clock.advance(infinite);
    for (PhaseClock* each : {&clock, &twin}) each->advance(1 / 30.0);
    ASSERT_EQ(clock.phase(), twin.phase());
    ASSERT_EQ(clock.cadence(), twin.cadence());
  }
  clock.set_cadence(1e9);
  EXPECT_LE(clock.cadence(), 8);
  clock.set_cadence(-3);
  EXPECT_GT(clock.cadence(), 0);
}

TEST(PhaseClock, in_blocks_it_goes_as_sample_by_sample) {
  for (const int size : {64, 96, 1000}) {
    PhaseClock blocks, single;
    std::vector<float> block(static_cast<std::size_t>(size));
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 0.1);
    double walked = 0;
    std::vector<std::pair<int, int>> in_blocks, one_by_one;  // sample and step
    for (int at = 0; at < 20 * 48000; at += size) {
      const double time = at / 48000.0;
      walked += (time < 8 ? 0.9 : 1.3) * size / 48000;
      // An estimate thirty times a second; it stands from 12 to 14 s.
      const bool frame = std::fmod(30 * time, 1.0) < 30.0 * size / 48000;
      const double seen = std::fmod(walked + noise(random) + 1, 1.0);
      for (PhaseClock* each : {&blocks, &single}) {
        if (frame) each->set_walking(time < 12 || time > 14), each->observe(seen);
      }
      blocks.process(block, 48000);
      for (const auto& crossing : blocks.crossings())
        in_blocks.push_back({at + crossing.sample, crossing.step});
      for (int i = 0; i < size; ++i) {
        float phase = 0;
        single.process({&phase, 1}, 48000);
        for (const auto& crossing : single.crossings())
          one_by_one.push_back({at + i, crossing.step});
        ASSERT_NEAR(std::remainder(block[static_cast<std::size_t>(i)] - phase, 1.0f), 0, 2e-5);
      }
      ASSERT_NEAR(blocks.cadence(), single.cadence(), 1e-4);
    }
    ASSERT_EQ(in_blocks.size(), one_by_one.size());
    ASSERT_GT(in_blocks.size(), 30u);
    int moved = 0;
    for (std::size_t i = 0; i < in_blocks.size(); ++i) {
      EXPECT_EQ(in_blocks[i].second, one_by_one[i].second);
      EXPECT_NEAR(in_blocks[i].first, one_by_one[i].first, 1) << "contact " << i;
      moved += in_blocks[i].first != one_by_one[i].first;
    }
    EXPECT_LE(moved, 6);  // of about forty, by one sample
  }
}

TEST(PhaseClock, moves_on_alike_whether_its_phase_is_heard_or_not) {
  PhaseClock heard, unheard, in_doubles;
  std::vector<float> block(64);
  std::vector<double> doubles(64);
  int crossings = 0;
  for (int i = 0; i < 3000; ++i) {
    if (i % 25 == 0)
      for (PhaseClock* each : {&heard, &unheard, &in_doubles})
        each->observe(std::fmod(i * 0.0012, 1.0));
    heard.process(block, 48000);
    unheard.process(64, 48000);
    in_doubles.process(doubles, 48000);
    ASSERT_EQ(heard.phase(), unheard.phase());
    ASSERT_EQ(heard.crossings().size(), unheard.crossings().size());
    for (std::size_t k = 0; k < heard.crossings().size(); ++k)
      EXPECT_EQ(heard.crossings()[k].sample, unheard.crossings()[k].sample);
    for (std::size_t k = 0; k < block.size(); ++k) ASSERT_NEAR(block[k], doubles[k], 1e-7);
    crossings += static_cast<int>(heard.crossings().size());
  }
  EXPECT_GT(crossings, 5);
}

// What starts a clock, and what does not.
TEST(PhaseClock, stands_until_somebody_walks) {
  const auto steps_in_three_seconds = [](PhaseClock& clock) {
    int steps = 0;
    for (int i = 0; i < 90; ++i) {
      clock.advance(1 / 30.0);
      steps += static_cast<int>(clock.crossings().size());
    }
    return steps;
  };
  using Act = void (*)(PhaseClock&);
  const Act nobody[] = {[](PhaseClock&) {},
                        [](PhaseClock& c) { c.set_cadence(2); },
                        [](PhaseClock& c) { c.set_pull(2); },
                        [](PhaseClock& c) { c.observe(std::nan("")); },
                        [](PhaseClock& c) { c.observe_contact(7); },
                        [](PhaseClock& c) { c.set_walking(false), c.observe(0.2); },
                        [](PhaseClock& c) { c.observe(0.2), c.advance(1), c.reset(); },
                        [](PhaseClock& c) { c.take_over(PhaseClock()); },
                        [](PhaseClock& c) {
                          PhaseClock stands;
                          stands.observe(0.3);
                          stands.set_walking(false);
                          c.take_over(stands);
                        }};
  for (std::size_t i = 0; i < std::size(nobody); ++i) {
    PhaseClock clock;
    nobody[i](clock);
    const float phase = clock.phase();
    EXPECT_EQ(steps_in_three_seconds(clock), 0) << i;
    EXPECT_EQ(clock.phase(), phase) << i;
    EXPECT_EQ(clock.cadence(), 0) << i;
    EXPECT_FALSE(clock.walking()) << i;
  }
  const Act somebody[] = {
      [](PhaseClock& c) { c.tap(); }, [](PhaseClock& c) { c.observe_contact(1); },
      [](PhaseClock& c) { c.observe(0.7); }, [](PhaseClock& c) { c.set_walking(true); },
      [](PhaseClock& c) {
        PhaseClock walks;
        walks.observe(0.7);
        c.take_over(walks);
      }};
  for (std::size_t i = 0; i < std::size(somebody); ++i) {
    PhaseClock clock;
    clock.set_cadence(2);
    somebody[i](clock);
    EXPECT_GE(steps_in_three_seconds(clock), 5) << i;
    EXPECT_TRUE(clock.walking()) << i;
  }
}

TEST(PhaseClock, settings_out_of_range_are_refused) {
  EXPECT_THROW(PhaseClock({.steps = 0}), Error);
  EXPECT_THROW(PhaseClock({.steps = 65}), Error);
  EXPECT_THROW(PhaseClock({.cadence = 0}), Error);
  EXPECT_THROW(PhaseClock({.slowest = 2, .fastest = 1}), Error);
  EXPECT_THROW(PhaseClock({.noise = -1}), Error);
  EXPECT_THROW(PhaseClock({.wander = std::numeric_limits<double>::quiet_NaN()}), Error);
}

TEST(PhaseClock, a_cycle_of_any_number_of_steps_meets_each_once) {
  for (const int steps : {1, 3, 7}) {
    PhaseClock clock({.steps = steps, .cadence = 4});
    clock.set_walking(true);
    std::vector<int> met;
    for (int frame = 0; frame < 300; ++frame) {
      clock.advance(1 / 30.0);
      for (const auto& crossing : clock.crossings()) met.push_back(crossing.step);
    }
    EXPECT_NEAR(static_cast<double>(met.size()), 40, 1);
    for (std::size_t i = 1; i < met.size(); ++i) EXPECT_EQ(met[i], (met[i - 1] + 1) % steps);
  }
}

}  // namespace
}  // namespace gait
