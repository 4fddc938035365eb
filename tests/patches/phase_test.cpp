// [gait.phase~]: its ramp, as sound, follows phases, contacts and taps; and what it refuses.
#include <gtest/gtest.h>

#include <cmath>

#include "patches/patch.h"

namespace gait::testing {
namespace {

// A patch that hears the four signals every 10 ms for some seconds.
struct PhasePatch : Patch {
  int phase;
  explicit PhasePatch(double milliseconds) {
    phase = object("gait.phase~");
    const int every = object("metro 10"), begin = object("loadbang");
    connect(begin, 0, every);
    for (int i = 0; i < 2; ++i) {
      const int heard = object("snapshot~");
      connect(phase, i, heard);
      connect(every, 0, heard);
      record(heard, 0, i == 0 ? "phase" : "cadence");
    }
    for (int i = 2; i < 4; ++i) {
      // Single samples: summed up, they are counted.
      const int sum = object("rpole~ 1"), heard = object("snapshot~");
      connect(phase, i, sum);
      connect(sum, 0, heard);
      connect(every, 0, heard);
      record(heard, 0, i == 2 ? "right" : "left");
    }
    record(phase, 4, "info");
    dsp();
    quit_after(milliseconds);
  }
};

TEST(PhaseObject, runs_at_the_cadence_it_is_given_and_touches_the_ground_once_a_step) {
  GAIT_NEEDS_PD();
  PhasePatch patch(10000);
  patch.at_start({"walking 1", "cadence 2"}, patch.phase);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto phase = run.numbers("phase", "float"), cadence = run.numbers("cadence", "float");
  ASSERT_GT(phase.size(), 900u);
  double way = 0;
  for (std::size_t i = 1; i < phase.size(); ++i) {
    const double step = phase[i][0] - phase[i - 1][0];
    way += step < -0.5 ? step + 1 : step;
    EXPECT_GE(step < -0.5 ? step + 1 : step, 0) << i;
  }
  EXPECT_NEAR(way, 10, 0.3);
  EXPECT_NEAR(cadence.back()[0], 2, 0.05);
  EXPECT_NEAR(run.numbers("right", "float").back()[0], 10, 1);
  EXPECT_NEAR(run.numbers("left", "float").back()[0], 10, 1);
  const auto info = run.recorded("info");
  EXPECT_NEAR(static_cast<double>(std::ranges::count(info, "contact right")), 10, 1);
  EXPECT_NEAR(static_cast<double>(std::ranges::count(info, "contact left")), 10, 1);
}

TEST(PhaseObject, follows_taps) {
  GAIT_NEEDS_PD();
  PhasePatch patch(8000);
  const int beat = patch.object("metro 400"), begin = patch.object("loadbang"),
            tap = patch.message("tap");
  patch.connect(begin, 0, beat);
  patch.connect(beat, 0, tap);
  patch.connect(tap, 0, patch.phase);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_NEAR(run.numbers("cadence", "float").back()[0], 2.5, 0.05);
}

TEST(PhaseObject, stands_still_when_told_to) {
  GAIT_NEEDS_PD();
  PhasePatch patch(4000);
  patch.at_start({"walking 0"}, patch.phase);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  const auto phase = run.numbers("phase", "float");
  EXPECT_EQ(phase.back()[0], phase[phase.size() / 2][0]);
}

TEST(PhaseObject, refuses_what_it_cannot_use) {
  GAIT_NEEDS_PD();
  PhasePatch patch(10);
  patch.at_start({"cadence fast", "cadence 0", "contact middle", "walking 2", "pull -1", "phase"},
                 patch.phase);
  patch.at_start({"dump"}, patch.phase);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors().size(), 6u) << run.log;
  EXPECT_NE(run.log.find("gait.phase~: contact: expected right or left, got 'middle'"),
            std::string::npos)
      << run.log;
  EXPECT_EQ(std::ranges::count(run.recorded("info"), "walking 0"), 1);
}

TEST(PhaseObject, stands_until_somebody_walks) {
  GAIT_NEEDS_PD();
  for (const std::string what : {"cadence 2", "pull 2", "tap", "contact left", "phase 0.2"}) {
    PhasePatch patch(3000);
    patch.at_start({what}, patch.phase);
    const PdRun run = run_pd(patch);
    ASSERT_EQ(run.exit_code, 0) << run.log;
    const bool starts = what != "cadence 2" && what != "pull 2";
    EXPECT_EQ(run.recorded("info").size() > 0, starts) << what;
    EXPECT_EQ(run.numbers("right", "float").back()[0] > 0, starts) << what;
    EXPECT_EQ(run.numbers("phase", "float").back()[0] > 0, starts) << what;
    EXPECT_EQ(run.numbers("cadence", "float").back()[0] > 0, starts) << what;
  }
}

// A signal that no cord takes is not written; a cord that comes while it plays is heard at once.
TEST(PhaseObject, is_heard_where_a_cord_is_made_while_it_plays) {
  GAIT_NEEDS_PD();
  Patch patch;
  const int phase = patch.object("gait.phase~"), heard = patch.object("snapshot~"),
            begin = patch.object("loadbang"), late = patch.object("del 500"),
            metro = patch.object("metro 10");
  patch.at_start({"walking 1"}, phase);
  patch.record(heard, 0, "phase");
  patch.record(phase, 4, "info");
  const int connect = patch.message("; pd-test.pd connect " + std::to_string(phase) + " 0 " +
                                    std::to_string(heard) + " 0");
  patch.connect(begin, 0, late);
  patch.connect(late, 0, connect);
  patch.connect(begin, 0, metro);
  patch.connect(metro, 0, heard);
  patch.dsp();
  patch.quit_after(1500);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  const auto values = run.numbers("phase", "float");
  ASSERT_GT(values.size(), 100u);
  EXPECT_EQ(values[40][0], 0);
  EXPECT_GT(values.back()[0], 0);
  EXPECT_GE(run.recorded("info").size(), 3u) << "contacts are told whatever is heard";
}

}  // namespace
}  // namespace gait::testing
