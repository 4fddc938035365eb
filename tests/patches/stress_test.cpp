// A hundred boxes made and deleted at random while sound runs, models of other sizes read under
// them. What is sought is a crash; under the address sanitizer, anything it finds.
#include <gtest/gtest.h>

#include <random>

#include "gait/corpus/corpus.h"
#include "gait/learn/trainer.h"
#include "gait/model/model_file.h"
#include "gait/teach/walk_model.h"
#include "patches/patch.h"

namespace gait::testing {
namespace {

// Fewer styles, other joints on either side, other states: every size differs from gait-demo's.
std::string other_model() {
  std::vector<Walk> walks;
  for (const char* style : {"sad", "cool"})
    for (int take = 1; take <= 2; ++take) {
      WalkPlan plan{.style = corpus_style(style)};
      plan.take = take;
      CorpusWalk walk = make_walk(plan);
      walks.push_back({std::move(walk.clip), walk.style, {}, {}, std::move(walk.contacts)});
    }
  const auto& joints = walks.front().clip.skeleton.joints;
  const JointRoles roles = find_roles(walks.front().clip.skeleton);
  WalkOptions walk_options;
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (roles.of_joint[i] == Role::head || roles.of_joint[i] == Role::left_arm ||
        roles.of_joint[i] == Role::right_arm || roles.of_joint[i] == Role::left_forearm)
      walk_options.input_joints.push_back(joints[i].name);
  const WalkSequences sequences = walk_sequences(walks, walk_options);
  LearningOptions options;
  options.states = 3;
  Model model = learn(walking_task(sequences), options).model;
  model.body = sequences.body;
  model.name = "other";
  add_style_space(model, walks);
  const std::string path = ::testing::TempDir() + "gait_other.gait";
  write_model(model, path);
  return path;
}

TEST(Stress, boxes_come_and_go_and_models_change_under_them) {
  GAIT_NEEDS_PD();
  const std::vector<std::string> kinds{
      "gait.pca stage style", "gait.pca stage speed",     "gait.phase~",
      "gait.model stage",     "gait.bvh stage",           "gait.viterbi~ stage",
      "gait.map stage",       "gait.synth stage",         "gait.skeleton stage",
      "gait.train mine",      "gait.train t -in 3 -out 1"};
  const std::vector<std::string> messages{"bang",
                                          "start",
                                          "stop",
                                          "style sad",
                                          "style proud 1 sad 2",
                                          "weight cool 1",
                                          "phase 0.3",
                                          "variation 2",
                                          "reset",
                                          "advance 0.5",
                                          "dump",
                                          "perf",
                                          "strength 2",
                                          "walking 0",
                                          "walking 1",
                                          "stream 0",
                                          "stream 1",
                                          "onlost walk",
                                          "onlost stop",
                                          "past 5",
                                          "future 3",
                                          "decoder lag 0.1",
                                          "decoder forward",
                                          "tap",
                                          "loop 1",
                                          "goto 1",
                                          "root still",
                                          "resend",
                                          "record a",
                                          "auto 0",
                                          "right",
                                          "left",
                                          "body pose",
                                          "cadence 2",
                                          "mask all 1",
                                          "in 1 2 3",
                                          "pose 1",
                                          "obs 1 2",
                                          "gauss 0 1",
                                          "out 0.5"};
  std::mt19937 random(11);
  const auto any = [&](int count) {
    return static_cast<int>(random() % static_cast<unsigned>(count));
  };
  const std::string demo = GAIT_PD_FOLDER "/gait-demo.gait", other = other_model();
  std::string score;
  const auto say = [&](const std::string& text, double after = 0) {
    score += std::to_string(after) + " " + text + ";\n";
  };
  say("model read " + demo);
  for (int round = 0; round < 12; ++round) {
    say("pd-stage clear", 3);
    const int boxes = 9;
    say("pd-stage obj 10 10 receive beat");
    for (int box = 1; box <= boxes; ++box) {
      say("pd-stage obj 10 " + std::to_string(20 * box) + " " +
              kinds[static_cast<std::size_t>(any(static_cast<int>(kinds.size())))],
          any(2));
      say("pd-stage connect 0 0 " + std::to_string(box) + " 0");
    }
    for (int beat = 0; beat < 60; ++beat) {
      if (beat % 20 == 7) say("model read " + (any(2) ? demo : other));
      say("beat " + messages[static_cast<std::size_t>(any(static_cast<int>(messages.size())))],
          any(20));
    }
    // Cords from anybody to anybody, on both inlets; loops are not asked for.
    for (int box = 1; box < boxes; ++box)
      say("pd-stage connect " + std::to_string(box) + " " + std::to_string(any(2)) + " " +
          std::to_string(box + 1) + " " + std::to_string(any(2)));
    for (int beat = 0; beat < 20; ++beat) say("beat bang", 33);
  }
  say("pd-stage clear", 10);
  Patch patch;
  patch.object("gait.model stage -blocking");
  patch.connect(patch.object("receive model"), 0, 0);
  patch.subpatch("stage");
  patch.dsp();
  patch.file("score.txt", score);
  patch.at_start({"read score.txt, rewind, bang"}, patch.object("qlist"));
  patch.quit_after(40000);
  const PdRun run = run_pd(patch);
  EXPECT_EQ(run.exit_code, 0) << run.log.substr(run.log.size() > 4000 ? run.log.size() - 4000 : 0);
  EXPECT_EQ(run.log.find("Sanitizer"), std::string::npos) << run.log;
}

// Everybody plays while a model of other sizes is read in the background.
TEST(Stress, a_model_is_swapped_under_players_without_a_long_tick) {
  GAIT_NEEDS_PD();
  Patch patch;
  const int model =
      patch.object(std::string("gait.model stage ") + GAIT_PD_FOLDER + "/gait-demo.gait -blocking");
  const int second = patch.object("gait.model stage");
  const int ticks = patch.object("ticks~"), begin = patch.object("loadbang");
  const int start = patch.message("start");
  patch.connect(begin, 0, start);
  for (int walker = 0; walker < 12; ++walker)
    patch.connect(start, 0,
                  patch.object(walker % 2 ? "gait.pca stage speed" : "gait.pca stage style"));
  for (int performer = 0; performer < 2; ++performer) {
    const int clip = patch.object("gait.bvh stage gait-demo:sad"),
              decoder = patch.object("gait.viterbi~ stage"), map = patch.object("gait.map stage"),
              synth = patch.object("gait.synth stage"),
              skeleton = patch.object("gait.skeleton stage");
    patch.connect(start, 0, clip);
    patch.connect(clip, 0, decoder);
    patch.connect(decoder, 4, map);
    patch.connect(map, 0, synth);
    patch.connect(synth, 0, skeleton);
    patch.connect(clip, 0, skeleton, 1);
  }
  patch.dsp();
  patch.file("score.txt",
             "1000 ticks 0;\n1000 ticks bang;\n0 ticks 0;\n0 model read " + other_model() + ";\n");
  patch.connect(patch.object("receive ticks"), 0, ticks);
  patch.connect(patch.object("receive model"), 0, model);
  patch.at_start({"read score.txt, rewind, bang"}, patch.object("qlist"));
  // Ready: a second later the longest tick is told, and the end.
  const int wait = patch.object("del 1000"), both = patch.object("t b b"),
            quit = patch.message("; pd quit 0");
  patch.connect(second, 0, wait);
  patch.connect(wait, 0, both);
  patch.connect(both, 1, ticks);
  patch.connect(both, 0, quit);
  const PdRun run = run_undisturbed(patch, 1000);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  std::vector<double> most;
  for (std::size_t at = run.log.find("ticks: "); at != std::string::npos;
       at = run.log.find("ticks: ", at + 1)) {
    double mean = 0, longest = 0;
    ASSERT_EQ(std::sscanf(run.log.c_str() + at, "ticks: %lf %lf", &mean, &longest), 2);
    std::printf("mean tick %.1f us, longest %.0f us\n", mean, longest);
    most.push_back(longest);
  }
  ASSERT_EQ(most.size(), 2u) << run.log;
  EXPECT_LT(most[1], 1000) << run.log;
}

}  // namespace
}  // namespace gait::testing
