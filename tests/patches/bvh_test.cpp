// [gait.bvh]: what it plays is what the core plays, what it records can be played and written, and
// what it refuses.
#include "gait/files/bvh.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "gait/corpus/corpus.h"
#include "gait/corpus/demo_motion.h"
#include "gait/model/model_file.h"
#include "gait/play/clips/clip_player.h"
#include "patches/patch.h"

namespace gait::testing {
namespace {

std::shared_ptr<const Model> demo() {
  static const auto model =
      std::make_shared<const Model>(read_model(GAIT_PD_FOLDER "/gait-demo.gait"));
  return model;
}

std::shared_ptr<const BodyMotion> walk(const std::string& name) {
  return std::make_shared<BodyMotion>(motion_named(name, *demo()));
}

void expect_near(const std::vector<double>& sent, std::span<const float> computed) {
  ASSERT_EQ(sent.size(), computed.size());
  for (std::size_t i = 0; i < sent.size(); ++i)
    EXPECT_NEAR(sent[i], computed[i], 2e-6 * std::max(1.0, std::abs(sent[i]))) << i;
}

std::size_t lines_with(const std::vector<std::string>& lines, const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      lines, [&](const std::string& line) { return line.starts_with(text); }));
}

std::vector<std::string> times(int count, const std::string& message) {
  return std::vector<std::string>(static_cast<std::size_t>(count), message);
}

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// A patch with the model there at once, and the object with its three outlets recorded.
struct BvhPatch : Patch {
  int bvh;
  explicit BvhPatch(const std::string& arguments) {
    object("gait.model gait-demo -blocking");
    bvh = object("gait.bvh " + arguments + " -blocking");
    record(bvh, 0, "in");
    record(bvh, 1, "truth");
    record(bvh, 2, "info");
  }
};

PdRun clean_run(Patch& patch, double milliseconds = 10) {
  patch.quit_after(milliseconds);
  const PdRun run = run_pd(patch);
  EXPECT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  return run;
}

void expect_played(const PdRun& run, ClipPlayer& player, int frames) {
  const auto in = run.numbers("in", "in"), pose = run.numbers("truth", "pose"),
             root = run.numbers("truth", "root"), time = run.numbers("info", "time");
  ASSERT_EQ(in.size(), static_cast<std::size_t>(frames));
  ASSERT_EQ(pose.size(), in.size());
  ASSERT_EQ(root.size(), in.size());
  ASSERT_EQ(time.size(), in.size());
  std::size_t contacts = 0;
  for (int i = 0; i < frames; ++i) {
    ASSERT_TRUE(player.advance());
    const PlayedFrame& frame = player.frame();
    expect_near(in[i], frame.inputs);
    expect_near(pose[i], frame.pose);
    const float place[4] = {frame.hips.x(), frame.hips.y(), frame.hips.z(), frame.heading};
    expect_near(root[i], place);
    EXPECT_NEAR(time[i][0], frame.time, 1e-5);
    contacts += std::size_t(frame.right) + std::size_t(frame.left);
  }
  EXPECT_EQ(lines_with(run.recorded("info"), "contact "), contacts);
}

TEST(BvhObject, plays_a_walk_as_the_core_does_and_says_when_it_ends) {
  GAIT_NEEDS_PD();
  const auto motion = walk("gait-demo:sad");
  BvhPatch patch("gait-demo gait-demo:sad");
  patch.at_start(times(motion->frames() + 5, "bang"), patch.bvh);
  const PdRun run = clean_run(patch);
  ClipPlayer player(demo());
  player.set_motion(motion);
  expect_played(run, player, motion->frames());
  const auto info = run.recorded("info");
  EXPECT_EQ(lines_with(info, "end"), 1u);
  EXPECT_EQ(info.back(), "end");
  EXPECT_EQ(lines_with(info, "label "), motion->labels.size());
}

TEST(BvhObject, opens_files_with_their_labels_and_plays_them_by_its_own_clock) {
  GAIT_NEEDS_PD();
  const std::filesystem::path folder = ::testing::TempDir() + "gait_bvh_object";
  CorpusWalk made = make_walk({.style = corpus_style("heavy"), .cycles = 3, .take = 7}, 60);
  const auto path = write_corpus(folder, {&made, 1}, 0.01).front();
  BvhPatch patch("gait-demo");
  patch.at_start({"open " + path.string(), "start", "start"}, patch.bvh);
  const PdRun run = clean_run(patch, 1010);
  ClipPlayer player(demo());
  player.set_motion(walk(path.string()));
  expect_played(run, player, 31);  // at 0, 1/30, ... 1 s
  EXPECT_NEAR(run.numbers("info", "length").back()[0], player.motion()->length(), 1e-4);
  std::filesystem::remove_all(folder);
}

TEST(BvhObject, loops_at_any_rate_and_goes_anywhere_as_the_core_does) {
  GAIT_NEEDS_PD();
  BvhPatch patch("gait-demo gait-demo:drunk");
  patch.at_start(std::vector<std::string>{"loop 0.4 2.1", "rate 1.7", "goto 1.5"} +
                     times(200, "bang") + std::vector<std::string>{"rate -0.6", "loop 1"} +
                     times(100, "bang"),
                 patch.bvh);
  const PdRun run = clean_run(patch);
  ClipPlayer player(demo());
  player.set_motion(walk("gait-demo:drunk"));
  player.set_loop(0.4, 2.1);
  player.set_speed(1.7);
  player.go_to(1.5);
  const auto root = run.numbers("truth", "root");
  ASSERT_EQ(root.size(), 300u);
  for (int i = 0; i < 300; ++i) {
    if (i == 200) {
      player.set_speed(-0.6);
      player.set_loop(true);
    }
    player.advance();
    const PlayedFrame& frame = player.frame();
    const float place[4] = {frame.hips.x(), frame.hips.y(), frame.hips.z(), frame.heading};
    expect_near(root[i], place);
  }
}

TEST(BvhObject, records_what_it_is_given_and_plays_it_in_a_loop_and_writes_it) {
  GAIT_NEEDS_PD();
  for (const bool whole : {true, false}) {
    BvhPatch patch("gait-demo gait-demo:cool");
    const int looper = patch.object("gait.bvh gait-demo -blocking");
    // The whole truth, or inputs and outputs apart (here the outputs of the map are the truth's).
    patch.connect(patch.bvh, whole ? 1 : 0, looper, 1);
    patch.record(looper, 0, "looped-in");
    patch.record(looper, 1, "looped-truth");
    patch.record(looper, 2, "looped-info");
    patch.at_start({"record 1", "record 1"}, looper);
    patch.at_start(times(60, "bang"), patch.bvh);
    patch.at_start(std::vector<std::string>{"record 0", "write looped.bvh"} + times(90, "bang"),
                   looper);
    const PdRun run = clean_run(patch);
    EXPECT_NEAR(run.numbers("looped-info", "length").back()[0], 2, 1e-5);
    const auto first = run.numbers("in", "in"), again = run.numbers("looped-in", "in");
    const auto root = run.numbers("truth", "root"), path = run.numbers("looped-truth", "root");
    ASSERT_EQ(again.size(), 90u);
    for (int i = 0; i < 90; ++i)
      for (std::size_t value = 0; value < first[i % 60].size(); ++value)
        EXPECT_NEAR(again[i][value], first[i % 60][value], 1e-5);
    ASSERT_EQ(lines_with(run.recorded("looped-info"), "written "), 1u);
    const Clip written = clip_from_bvh(read_bvh(run.folder + "/looped.bvh"));
    EXPECT_EQ(written.frames(), 60);
    EXPECT_EQ(written.frame_rate, 30);
    if (!whole) continue;
    for (int i = 0; i < 60; ++i) EXPECT_NEAR(path[i][2], root[i][2], 1e-5);
    EXPECT_GT(path[89][2], path[59][2]);  // the way goes on where the loop goes back
    const int hips = body_roles(*demo()->body).hips;
    for (int i = 0; i < 60; ++i) EXPECT_NEAR(written.translation(i)[hips].z(), root[i][2], 1e-5);
  }
}

TEST(BvhObject, clears_what_was_recorded_and_plays_what_was_opened) {
  GAIT_NEEDS_PD();
  BvhPatch patch("gait-demo gait-demo:cool");
  const int source = patch.object("gait.bvh gait-demo gait-demo:sad -blocking");
  patch.connect(source, 1, patch.bvh, 1);
  patch.at_start({"record 1"}, patch.bvh);
  patch.at_start(times(10, "bang"), source);
  patch.at_start({"record 0", "bang", "clear", "bang"}, patch.bvh);
  const PdRun run = clean_run(patch);
  ClipPlayer cool(demo()), sad(demo());
  cool.set_motion(walk("gait-demo:cool"));
  sad.set_motion(walk("gait-demo:sad"));
  cool.advance();
  sad.advance();
  const auto pose = run.numbers("truth", "pose");
  ASSERT_EQ(pose.size(), 2u);
  for (std::size_t i = 0; i < pose[0].size(); ++i) {
    EXPECT_NEAR(pose[0][i], sad.frame().pose[i], 1e-5);
    EXPECT_NEAR(pose[1][i], cool.frame().pose[i], 1e-5);
  }
}

TEST(BvhObject, plays_several_performers_by_their_numbers) {
  GAIT_NEEDS_PD();
  BvhPatch patch("gait-demo -poly 3");
  patch.at_start({"1 open gait-demo:heavy", "bang", "1 bang", "2 goto 1", "2 bang"}, patch.bvh);
  const PdRun run = clean_run(patch);
  // Lists: number, selector, values.
  std::vector<std::pair<std::string, std::vector<double>>> frames;
  const auto lines = run.recorded("in");
  ASSERT_EQ(lines.size(), 5u);
  const std::vector<std::string> begins{"list 0 in ", "list 1 in ", "list 2 in ", "list 1 in ",
                                        "list 2 in "};
  for (std::size_t i = 0; i < lines.size(); ++i)
    EXPECT_TRUE(lines[i].starts_with(begins[i])) << lines[i];
  EXPECT_NE(lines[0].substr(7), lines[2].substr(7));  // other styles unless told
  EXPECT_EQ(lines_with(run.recorded("info"), "list 2 time 1"), 1u);
}

TEST(BvhObject, allocates_nothing_while_it_plays_and_records) {
  GAIT_NEEDS_PD();
  if (!can_watch()) GTEST_SKIP() << "the sanitizer has an allocator of its own";
  Patch patch;
  patch.object("gait.model gait-demo -blocking");
  const int watch = patch.object("watch"),
            bvh = patch.object("gait.bvh gait-demo gait-demo:drunk -blocking"),
            looper = patch.object("gait.bvh gait-demo -blocking");
  patch.connect(bvh, 1, looper, 1);
  patch.at_start({"loop 0.5 2.5", "rate 0.7"}, bvh);
  patch.at_start({"record 1"}, looper);
  const std::vector<std::string> frames = times(100, "bang");
  patch.at_start(frames, bvh);  // buffers grow once, and every half minute of recording
  patch.at_start({"1"}, watch);
  patch.at_start(frames + std::vector<std::string>{"goto 1", "rate 2"} + frames, bvh);
  patch.at_start({"0"}, watch);
  patch.quit_after(10);
  const PdRun run = run_pd(patch, {.home = "", .state = "", .watched = true});
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(watched_allocations(run), 0) << run.log;
}

TEST(BvhObject, is_restored_by_its_dump) {
  GAIT_NEEDS_PD();
  BvhPatch patch("gait-demo");
  patch.at_start({"open gait-demo:heavy:2", "rate 0.5", "loop 1 2.5", "dump"}, patch.bvh);
  const auto info = clean_run(patch).recorded("info");
  for (const char* line : {"open gait-demo:heavy:2", "rate 0.5", "loop 1 2.5"})
    EXPECT_EQ(lines_with(info, line), 1u) << line;
}

TEST(BvhObject, refuses_what_it_cannot_use_with_one_line_each) {
  GAIT_NEEDS_PD();
  BvhPatch patch("gait-demo gait-demo:sad");
  patch.at_start({"bang", "open nowhere.bvh", "open gait-demo:furious", "loop 2 1", "loop x",
                  "rate fast", "goto -1", "record 0.5", "write 3", "sing", "5", "bang"},
                 patch.bvh);
  patch.at_start({"record 1"}, patch.bvh);
  patch.at_start({"pose 1 2 3", "out a b", "weather 1"}, patch.bvh, 1);
  patch.at_start({"record 0", "bang"}, patch.bvh);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  const auto said = [&](const std::string& text) {
    EXPECT_NE(run.log.find(text), std::string::npos) << text << "\n" << run.log;
  };
  said("gait.bvh: open: no file 'nowhere.bvh'");
  said("furious");
  said("gait.bvh: loop: expected an end after the beginning, got 1");
  said("gait.bvh: loop: expected a number, got 'x'");
  said("gait.bvh: rate: expected a number, got 'fast'");
  said("gait.bvh: goto: expected a number from 0 to 1e+06, got -1");
  said("gait.bvh: record: expected 0 or 1, got 0.5");
  said("gait.bvh: write: expected a name, got 3");
  said("gait.bvh: sing: no such message");
  said("gait.bvh: list: expected 0 or 1, got 5");
  said("gait.bvh: pose: expected ");
  said("gait.bvh: weather: no such message at the right inlet");
  said("gait.bvh: record: nothing was recorded");
  // Wrong frames are said once a second at most; all else once each.
  EXPECT_EQ(run.errors().size(), 13u) << run.log;
  // And the walk goes on as if nothing had been said.
  ClipPlayer player(demo());
  player.set_motion(walk("gait-demo:sad"));
  const auto in = run.numbers("in", "in");
  ASSERT_EQ(in.size(), 3u);
  for (const auto& frame : in) {
    player.advance();
    expect_near(frame, player.frame().inputs);
  }
}

}  // namespace
}  // namespace gait::testing
