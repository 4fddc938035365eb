// [gait.viterbi~] among signals of many channels, which Pd has since 0.54. In an older Pd it says
// so.
#include <gtest/gtest.h>

#include "patches/viterbi_patch.h"

namespace gait::testing {
namespace {

bool has_channels() {
  Patch patch;
  patch.object("snake~ in 2");
  patch.quit_after(1);
  return run_pd(patch).errors().empty();
}

#define GAIT_NEEDS_CHANNELS() \
  GAIT_NEEDS_PD();            \
  if (!has_channels()) GTEST_SKIP() << "this Pd has no multichannel signals (0.54 or later has)"

// As its errors name them: of the input joints, of the whole body.
std::string sizes_of_frames() {
  return std::to_string(demo()->input.values) + " or " +
         std::to_string(3 * demo()->body->references.size());
}

// One oscillator per value of a frame, none like another.
std::string oscillator(int value) { return "osc~ " + std::to_string(0.7 + 0.05 * value); }

TEST(Multichannel, a_frame_on_one_cord_is_a_frame_on_many) {
  GAIT_NEEDS_CHANNELS();
  const int values = demo()->input.values;
  ChainPatch patch(" -mc");
  const int many = patch.object("gait.viterbi~ gait-demo -signals " + std::to_string(values));
  const int snake = patch.object("snake~ in " + std::to_string(values));
  patch.record(many, 4, "many");
  for (int i = 0; i < values; ++i) {
    const int source = patch.object(oscillator(i)), small = patch.object("*~ 0.3");
    patch.connect(source, 0, small);
    patch.connect(small, 0, snake, i);
    patch.connect(small, 0, many, i + 1);
  }
  patch.connect(snake, 0, patch.viterbi, 1);
  // What it puts out stays one channel, and is heard.
  const int out = patch.object("snake~ out 2"), beat = patch.object("metro 50");
  patch.connect(patch.viterbi, 1, out);
  for (int channel = 0; channel < 2; ++channel) {
    const int seen = patch.object("snapshot~");
    patch.connect(out, channel, seen);
    patch.connect(beat, 0, seen);
    patch.record(seen, 0, channel == 0 ? "cadence" : "beside");
  }
  patch.at_start({"1"}, beat);
  patch.dsp();
  patch.quit_after(1000);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto one = run.numbers("cord", "obs");
  EXPECT_NEAR(static_cast<double>(one.size()), 30, 1);
  EXPECT_EQ(one, run.numbers("many", "obs"));
  EXPECT_NE(one.front(), one.back()) << "the oscillators move";
  double fastest = 0, beside = 0;
  for (const auto& row : run.numbers("cadence", "float")) fastest = std::max(fastest, row.at(0));
  for (const auto& row : run.numbers("beside", "float")) beside = std::max(beside, row.at(0));
  EXPECT_GT(fastest, 0.1);
  EXPECT_EQ(beside, 0);
}

TEST(Multichannel, the_wrong_number_of_channels_is_refused_by_both_numbers) {
  GAIT_NEEDS_CHANNELS();
  const std::string values = sizes_of_frames();
  ChainPatch patch(" -mc");
  const int snake = patch.object("snake~ in 5");
  patch.connect(patch.object(oscillator(0)), 0, snake, 4);
  patch.connect(snake, 0, patch.viterbi, 1);
  // Without a cord it is one channel.
  patch.object("gait.viterbi~ gait-demo -mc");
  patch.dsp();
  patch.quit_after(200);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  for (const char* found : {"5", "1"})
    EXPECT_NE(run.log.find("expected " + values + " numbers, got " + found), std::string::npos)
        << run.log;
  EXPECT_EQ(run.errors().size(), 2u) << "each box says it once\n" << run.log;
  EXPECT_TRUE(run.numbers("cord", "obs").empty());
}

TEST(Multichannel, an_inlet_for_one_value_takes_the_first_channel) {
  GAIT_NEEDS_CHANNELS();
  const int values = demo()->input.values;
  ChainPatch patch(" -signals " + std::to_string(values));
  const int single = patch.object("gait.viterbi~ gait-demo -signals " + std::to_string(values));
  patch.record(single, 4, "single");
  const int source = patch.object(oscillator(3)), snake = patch.object("snake~ in 3");
  patch.connect(source, 0, snake);
  patch.connect(patch.object(oscillator(9)), 0, snake, 1);
  patch.connect(snake, 0, patch.viterbi, 4);
  patch.connect(source, 0, single, 4);
  patch.dsp();
  patch.quit_after(500);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  EXPECT_GT(run.numbers("cord", "obs").size(), 10u);
  EXPECT_EQ(run.numbers("cord", "obs"), run.numbers("single", "obs"));
}

// Cords come and go, and with them channels, while the walk plays.
TEST(Multichannel, another_number_of_channels_comes_while_it_plays) {
  GAIT_NEEDS_CHANNELS();
  const int values = demo()->input.values;
  Patch patch;
  patch.object("gait.model gait-demo -blocking");
  patch.subpatch("channels");
  const std::string fill =
      "; pd-channels obj 10 10 snake~ in " + std::to_string(values) +
      "; pd-channels obj 10 50 gait.viterbi~ gait-demo -mc; pd-channels obj 10 90 snake~ in 2"
      "; pd-channels obj 10 130 print OBS; pd-channels connect 1 4 3 0"
      "; pd-channels connect 2 0 1 1";
  const int begin = patch.object("loadbang"), made = patch.message(fill);
  patch.connect(begin, 0, made);
  const int later = patch.object("delay 300"),
            other = patch.message("; pd-channels disconnect 2 0 1 1; pd-channels connect 0 0 1 1");
  patch.connect(begin, 0, later);
  patch.connect(later, 0, other);
  patch.dsp();
  patch.quit_after(800);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_NE(run.log.find("expected " + sizes_of_frames() + " numbers, got 2"), std::string::npos)
      << run.log;
  EXPECT_NE(run.log.find("OBS: obs "), std::string::npos) << run.log;
}

TEST(Multichannel, an_older_pd_is_named_in_the_error) {
  GAIT_NEEDS_PD();
  if (has_channels()) GTEST_SKIP() << "this Pd has multichannel signals";
  Patch patch;
  patch.object("gait.viterbi~ gait-demo -mc");
  patch.quit_after(1);
  const PdRun run = run_pd(patch);
  EXPECT_NE(run.log.find("gait.viterbi~: -mc: expected Pd 0.54 or later"), std::string::npos)
      << run.log;
}

}  // namespace
}  // namespace gait::testing
