// [gait.train]: taught in a patch, in time, as a performer would.
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <numbers>
#include <random>
#include <thread>

#include "gait/corpus/corpus.h"
#include "gait/model/model_file.h"
#include "gait/teach/takes_file.h"
#include "patches/patch.h"

namespace gait::testing {
namespace {

// For [qlist]: milliseconds to wait, then who gets what.
struct Score {
  std::string text;
  std::mt19937_64 random{7};

  void say(const std::string& message, double after = 0) {
    text += std::to_string(after) + " teach " + message + ";\n";
  }
  void gesture(const std::string& label, int frames) {
    std::normal_distribution<double> noise(0, 0.02);
    std::uniform_real_distribution<double> share(-1, 1);
    say("record " + label);
    const double size = 1 + 0.2 * share(random), count = frames * (1 + 0.2 * share(random));
    for (int frame = 0; frame < count; ++frame) {
      const double s = 2 * std::numbers::pi * frame / count;
      const double x = label == "circle" ? std::cos(s)
                       : label == "line" ? s / 3 - 1
                                         : std::sin(2 * s);
      const double y = label == "circle" ? std::sin(s) : label == "line" ? 0.2 * s : std::cos(s);
      say("in " + std::to_string(size * x + noise(random)) + " " +
              std::to_string(size * y + noise(random)),
          20);
    }
    say("stop");
  }
};

struct TrainPatch : Patch {
  int train;
  TrainPatch(const std::string& arguments, const std::string& score) {
    train = object("gait.train " + arguments);
    record(train, 0, "done");
    record(train, 1, "info");
    const int teach = object("receive teach");
    connect(teach, 0, train);
    file("score.txt", score);
    at_start({"read score.txt, rewind, bang"}, object("qlist"));
  }
};

std::string gestures() {
  Score score;
  for (int take = 0; take < 6; ++take)
    for (const char* label : {"circle", "line", "wave"}) score.gesture(label, 40);
  return score.text;
}

TEST(TrainObject, learns_gestures_and_says_how_well) {
  GAIT_NEEDS_PD();
  TrainPatch patch("moves -in 2 -blocking",
                   gestures() + "100 teach train;\n10 teach write moves.gait;\n");
  const int model = patch.object("gait.model moves");
  patch.record(model, 1, "model");
  patch.quit_after(30000);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto done = run.numbers("done", "done");
  ASSERT_EQ(done.size(), 1u) << run.log;
  EXPECT_GE(done[0][0], 0.98);
  EXPECT_EQ(std::ranges::count_if(run.recorded("info"),
                                  [](const auto& line) { return line.starts_with("take "); }),
            18);
  EXPECT_EQ(std::ranges::count(run.recorded("model"), "ready moves"), 1);
  const Model learnt = read_model(run.folder + "/moves.gait");
  ASSERT_EQ(learnt.labels.size(), 3u);
  EXPECT_EQ(learnt.labels[0].name, "circle");
  EXPECT_EQ(learnt.input.values, 2);
}

// Taught, then moved: three gestures, and one that was never shown.
TEST(TrainObject, teaches_gestures_that_are_recognised_at_once_and_others_rejected) {
  GAIT_NEEDS_PD();
  Score score;
  score.text = gestures() + "100 teach train;\n";
  const auto move = [&](double size, double frequency, double phase) {
    for (int frame = 0; frame < 90; ++frame) {
      const double s = 2 * std::numbers::pi * frame / 40;
      score.text += "20 seen in " + std::to_string(size * std::cos(s)) + " " +
                    std::to_string(size * std::sin(frequency * s + phase)) + ";\n";
    }
  };
  move(1, 1, 0);
  move(3, 3, 0.5);
  TrainPatch patch("moves -in 2 -blocking", score.text);
  const int seen = patch.object("gait.viterbi~ moves"), steps = patch.object("route step");
  patch.connect(patch.object("receive seen"), 0, seen);
  patch.connect(seen, 5, steps);
  patch.record(steps, 0, "steps");
  patch.quit_after(60000);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto told = run.recorded("steps");
  ASSERT_FALSE(told.empty());
  EXPECT_NE(std::ranges::find(told, "circle"), told.end());
  EXPECT_EQ(told.back(), "null");
}

TEST(TrainObject, loses_no_take_when_pd_ends) {
  GAIT_NEEDS_PD();
  std::string state = ::testing::TempDir() + "gait_state_XXXXXX";
  ASSERT_NE(mkdtemp(state.data()), nullptr);
  const RunOptions options{.home = "", .state = state, .watched = false};
  {
    TrainPatch patch("moves -in 2 -blocking", gestures());
    patch.quit_after(30000);
    EXPECT_EQ(run_pd(patch, options).exit_code, 0);
  }
  EXPECT_EQ(read_takes(state + "/gait/moves.takes").size(), 18u);
  TrainPatch patch("moves -in 2 -blocking", "");
  patch.at_start({"add " + state + "/gait/moves.takes.1", "remove 0", "list"}, patch.train);
  patch.quit_after(10);
  const PdRun run = run_pd(patch, options);
  EXPECT_NE(run.log.find("takes of an earlier session are in " + state), std::string::npos)
      << run.log;
  const auto info = run.recorded("info");
  EXPECT_EQ(info.size(), 18u + 17u) << run.log;
  EXPECT_TRUE(info[0].starts_with("take 0 circle ")) << info[0];
  EXPECT_TRUE(info[18].starts_with("take 0 line ")) << info[18];
}

TEST(TrainObject, loses_no_take_when_pd_is_killed) {
  GAIT_NEEDS_PD();
  std::string state = ::testing::TempDir() + "gait_state_XXXXXX";
  ASSERT_NE(mkdtemp(state.data()), nullptr);
  RunOptions options{.state = state};
  {
    Score score;
    for (const char* label : {"circle", "line", "wave"}) score.gesture(label, 20);
    TrainPatch patch("moves -in 2", score.text);
    options.meanwhile = [](const PdRun& running) {
      EXPECT_TRUE(running.wait_for("info", "take 2 wave"));
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      EXPECT_EQ(kill(running.process(), SIGKILL), 0);
    };
    EXPECT_NE(run_pd(patch, options).exit_code, 0);
    options.meanwhile = {};
  }
  TrainPatch patch("moves -in 2 -blocking", "");
  patch.at_start({"add " + state + "/gait/moves.takes.1"}, patch.train);
  patch.quit_after(10);
  const PdRun run = run_pd(patch, options);
  EXPECT_NE(run.log.find("takes of an earlier session are in " + state), std::string::npos)
      << run.log;
  const auto info = run.recorded("info");
  ASSERT_EQ(info.size(), 3u) << run.log;
  EXPECT_TRUE(info[2].starts_with("take 2 wave ")) << info[2];
}

// At moments of a recording that nothing in the box knows of.
TEST(TrainObject, loses_a_second_at_most_of_a_take_when_pd_is_killed_while_it_records) {
  GAIT_NEEDS_PD();
  std::mt19937 random(17);
  std::uniform_real_distribution<double> moment(1.2, 3);
  double most_lost = 0;
  for (int time = 0; time < 20; ++time) {
    std::string state = ::testing::TempDir() + "gait_state_XXXXXX";
    ASSERT_NE(mkdtemp(state.data()), nullptr);
    RunOptions options{.state = state};
    double recorded = 0;
    {
      Score score;
      score.say("record wave");
      for (int frame = 0; frame < 200; ++frame) score.say("in " + std::to_string(frame) + " 1", 20);
      TrainPatch patch("moves -in 2", score.text);
      patch.record(patch.object("receive teach"), 0, "given");
      options.meanwhile = [&](const PdRun& running) {
        EXPECT_TRUE(running.wait_for("given", "record"));
        std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
        recorded = 0.02 * static_cast<double>(running.recorded("given").size() - 2);
        EXPECT_EQ(kill(running.process(), SIGKILL), 0);
      };
      EXPECT_NE(run_pd(patch, options).exit_code, 0);
      options.meanwhile = {};
    }
    TrainPatch patch("moves -in 2 -blocking", "");
    patch.at_start({"restore"}, patch.train);
    patch.quit_after(10);
    const PdRun run = run_pd(patch, options);
    double offered = 0, restored = 0;
    for (const std::string& line : run.recorded("info")) {
      std::sscanf(line.c_str(), "unfinished wave %lf", &offered);
      std::sscanf(line.c_str(), "take 0 wave %lf", &restored);
    }
    EXPECT_GT(offered, 0) << run.log;
    EXPECT_EQ(offered, restored);
    most_lost = std::max(most_lost, recorded - restored);
  }
  std::printf("at most %.2f s lost\n", most_lost);
  EXPECT_LE(most_lost, 1);
}

// What [gait.osc] says beside frames is no error; what is one is said once a second.
TEST(TrainObject, says_what_frames_cause_once_a_second) {
  GAIT_NEEDS_PD();
  std::string score;
  for (int frame = 0; frame < 100; ++frame)
    score += "20 teach root 0 0 0 0;\n0 teach mask LeftArm 0;\n0 teach dance " +
             std::to_string(frame) + ";\n0 teach jump;\n";
  TrainPatch patch("moves -in 2 -blocking", score);
  const int map = patch.object("gait.map gait-demo");
  patch.connect(patch.object("receive teach"), 0, map);
  patch.quit_after(2300);
  const PdRun run = run_pd(patch, {});
  const auto errors = run.errors();
  int dances = 0, roots = 0, maps = 0;
  for (const std::string& line : errors) {
    dances += line.find("gait.train: dance: no such message") != std::string::npos ? 1 : 0;
    roots += line.find("gait.train: root") != std::string::npos ||
                     line.find("gait.train: mask") != std::string::npos
                 ? 1
                 : 0;
    maps += line.find("gait.map: root") != std::string::npos ? 1 : 0;
  }
  EXPECT_EQ(roots, 0) << run.log;
  EXPECT_GE(dances, 2) << run.log;
  EXPECT_LE(dances, 3) << run.log;
  EXPECT_GE(maps, 1) << run.log;
  EXPECT_LE(errors.size(), 6u * 3u) << run.log;
}

TEST(TrainObject, learns_walks_from_poses) {
  GAIT_NEEDS_PD();
  Patch patch;
  patch.object("gait.model gait-demo -blocking");
  const int train = patch.object("gait.train mine -blocking"), walker = patch.object("gait.pca");
  patch.record(train, 0, "done");
  patch.record(train, 1, "info");
  patch.connect(walker, 0, train);
  // Two styles, ten seconds each, twice.
  std::string score;
  for (int take = 0; take < 2; ++take)
    for (const char* style : {"sad", "proud"})
      score += std::string("0 walk style ") + style + ";\n0 walk start;\n1000 teach record " +
               style + ";\n10000 teach stop;\n0 walk stop;\n";
  score += "10 teach train;\n";
  patch.file("score.txt", score);
  for (const auto& [name, to] : {std::pair{"teach", train}, {"walk", walker}})
    patch.connect(patch.object(std::string("receive ") + name), 0, to);
  patch.at_start({"read score.txt, rewind, bang"}, patch.object("qlist"));
  patch.quit_after(50000);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto done = run.numbers("done", "done");
  ASSERT_EQ(done.size(), 1u) << run.log;
  EXPECT_GE(done[0][0], 0.9);
  EXPECT_EQ(std::ranges::count(run.recorded("info"), "ready mine"), 1);
}

TEST(TrainObject, takes_clips_for_takes) {
  GAIT_NEEDS_PD();
  WalkPlan plan{.style = corpus_style("sad")};
  const CorpusWalk walk = make_walk(plan);
  const auto path = write_corpus(::testing::TempDir() + "gait_clips", {&walk, 1}, 0.01).front();
  Patch patch;
  patch.object("gait.model gait-demo -blocking");
  const int train = patch.object("gait.train mine -blocking");
  patch.record(train, 1, "info");
  patch.at_start({"add " + path.string()}, train);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto info = run.recorded("info");
  ASSERT_EQ(info.size(), 1u) << run.log;
  ASSERT_TRUE(info[0].starts_with("take 0 sad ")) << info[0];
  EXPECT_NEAR(std::stod(info[0].substr(11)), (walk.clip.frames() - 1) / walk.clip.frame_rate, 1e-3);
}

TEST(TrainObject, refuses_what_it_cannot_use) {
  GAIT_NEEDS_PD();
  TrainPatch patch("moves -in 2 -blocking", "");
  patch.at_start({"train", "stop", "record", "undo", "cancel", "remove 0", "write x.gait",
                  "add nowhere.takes", "hello", "in 1 2 3", "pose 1 2"},
                 patch.train);
  patch.object("gait.train");
  patch.object("gait.train moves2 -out 2");
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  for (const char* text :
       {"gait.train: train: there are no takes to learn from",
        "gait.train: stop: nothing is being recorded", "gait.train: record: expected 1 argument",
        "gait.train: undo: there is nothing to undo", "gait.train: cancel: nothing is being learnt",
        "gait.train: remove: there are no takes", "gait.train: write: expected after 'train'",
        "gait.train: add: no file 'nowhere.takes'", "gait.train: hello: no such message",
        "gait.train: in: expected 2 numbers, got 3", "gait.train: pose: expected 'in'",
        "gait.train: expected a name for what is learnt", "gait.train: expected -in beside -out"})
    EXPECT_NE(run.log.find(text), std::string::npos) << text << "\n" << run.log;
}

}  // namespace
}  // namespace gait::testing
