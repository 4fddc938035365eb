// [gait.viterbi~] and [gait.map]: what they send is what the core computes, and what they refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "patches/viterbi_patch.h"

namespace gait::testing {
namespace {

void expect_near(const std::vector<double>& sent, const std::vector<float>& expected,
                 double tolerance) {
  ASSERT_EQ(sent.size(), expected.size());
  for (std::size_t i = 0; i < sent.size(); ++i)
    ASSERT_NEAR(sent[i], expected[i], tolerance * (1 + std::abs(expected[i]))) << i;
}

TEST(ViterbiObject, with_the_map_sends_the_gaussians_that_the_core_computes) {
  GAIT_NEEDS_PD();
  ChainPatch patch;
  const Eigen::MatrixXf inputs = inputs_of(unseen_walk("drunk"));
  std::vector<std::string> messages{"rate 30"};
  for (int frame = 0; frame < inputs.cols(); ++frame)
    messages.push_back(message_of(frame % 2 == 0 ? "in" : "list", inputs.col(frame)));
  patch.at_start({"strength 1.25"}, patch.map);
  patch.at_start(messages, patch.viterbi);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;

  const Computed expected = computed(inputs, 1.25f);
  const auto gauss = run.numbers("gauss", "gauss"), styles = run.numbers("info", "styles"),
             phases = run.numbers("info", "phase"), distances = run.numbers("distance", "distance");
  ASSERT_EQ(gauss.size(), static_cast<std::size_t>(inputs.cols()));
  ASSERT_EQ(styles.size(), gauss.size());
  for (std::size_t frame = 0; frame < gauss.size(); ++frame) {
    expect_near(gauss[frame], expected.gauss[frame], 1e-5);
    expect_near(styles[frame], expected.styles[frame], 1e-3);
    EXPECT_NEAR(phases[frame][0], expected.decisions[frame].phase, 1e-4);
    EXPECT_NEAR(distances[frame][0], expected.decisions[frame].distance, 1e-2);
  }
  const auto info = run.recorded("info");
  EXPECT_NE(std::ranges::find(info, "stream 1"), info.end());
  EXPECT_TRUE(
      std::ranges::any_of(info, [](const auto& l) { return l.starts_with("style drunk"); }));
  EXPECT_EQ(run.recorded("gauss").front(), "stream 1") << "passed through";
}

TEST(ViterbiObject, each_obs_stands_for_itself) {
  GAIT_NEEDS_PD();
  ChainPatch patch;
  const int gate = patch.object("spigot 1"), other = patch.object("gait.map gait-demo");
  patch.connect(patch.viterbi, 4, gate);
  patch.connect(gate, 0, other);
  patch.record(other, 0, "gated");
  const Eigen::MatrixXf inputs = inputs_of(unseen_walk("sad")).leftCols(60);
  std::vector<std::string> frames;
  for (int frame = 0; frame < 60; ++frame) frames.push_back(message_of("in", inputs.col(frame)));
  const auto part = [&](int begin, int end) {
    return std::vector<std::string>(frames.begin() + begin, frames.begin() + end);
  };
  patch.at_start({"rate 30"}, patch.viterbi);
  patch.at_start(part(0, 20), patch.viterbi);
  patch.at_start({"0"}, gate, 1);
  patch.at_start(part(20, 40), patch.viterbi);
  patch.at_start({"1"}, gate, 1);
  patch.at_start(part(40, 60), patch.viterbi);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  auto all = run.numbers("gauss", "gauss");
  ASSERT_EQ(all.size(), 60u) << run.log;
  all.erase(all.begin() + 20, all.begin() + 40);
  EXPECT_EQ(run.numbers("gated", "gauss"), all);
}

TEST(ViterbiObject, takes_signals_joints_and_whole_bodies_for_frames) {
  GAIT_NEEDS_PD();
  const Model& model = *demo();
  const int values = model.input.values, inputs = static_cast<int>(model.inputs.size());
  const Eigen::VectorXf frame = inputs_of(unseen_walk("sad")).col(20);
  ChainPatch patch(" -signals " + std::to_string(values));
  for (int i = 0; i < values; ++i) {
    char number[48];
    std::snprintf(number, sizeof number, "sig~ %.9g", static_cast<double>(frame[i]));
    patch.connect(patch.object(number), 0, patch.viterbi, i + 1);
  }
  const int second = patch.object("gait.viterbi~ gait-demo"),
            third = patch.object("gait.viterbi~ gait-demo");
  patch.record(second, 4, "joints");
  patch.record(third, 4, "body");
  std::vector<std::string> messages;
  for (int i = 0; i < inputs; ++i)
    messages.push_back(
        message_of("joint " + (i % 2 == 0 ? std::to_string(i) : model.inputs[i].name),
                   frame.segment(3 * i, 3)));
  messages.push_back("bang");
  patch.at_start(messages, second);
  Eigen::VectorXf pose = Eigen::VectorXf::Zero(3 * model.body->references.size());
  for (int i = 0; i < inputs; ++i)
    pose.segment(3 * model.body->input_joints[i], 3) = frame.segment(3 * i, 3);
  patch.at_start({message_of("pose", pose)}, third);
  patch.dsp();
  patch.quit_after(200);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto signals = run.numbers("cord", "obs"), joints = run.numbers("joints", "obs"),
             body = run.numbers("body", "obs");
  EXPECT_NEAR(static_cast<double>(signals.size()), 6, 1);
  ASSERT_EQ(joints.size(), 1u);
  ASSERT_EQ(body.size(), 1u);
  // The first frame's observation: LAG K s w ... 0 D, then the statics.
  const int statics = model.input.statics();
  for (const auto* row : {&signals.front(), &joints.front(), &body.front()})
    for (int i = 0; i < statics; ++i)
      EXPECT_NEAR(row->at(row->size() - statics + i), frame[model.input.modelled[i]], 1e-5) << i;
}

TEST(ViterbiObject, dumps_what_restores_it_and_refuses_the_rest_with_one_line_each) {
  GAIT_NEEDS_PD();
  ChainPatch patch;
  const std::string joint = demo()->inputs[1].name, output = demo()->outputs[2].name;
  patch.at_start({"decoder lag 0.1",
                  "rate 60",
                  "memory 2",
                  "margin 0.2",
                  "hold 0.5",
                  "timeout 1",
                  "onlost walk 4",
                  "mask " + joint + " 0",
                  "dump",
                  "in 1 2 3",
                  "pose loud",
                  "decoder best",
                  "decoder lag",
                  "mask nobody 0",
                  "mask 0 2",
                  "margin 2",
                  "timeout 0",
                  "onlost fly",
                  "euler 0 ZZX 1 2 3",
                  "quat 0 0 0 0 0",
                  "joint 99 1 2 3"},
                 patch.viterbi);
  patch.at_start({"strength 0.5", "strength " + output + " 2", "bias " + output + " 0.25 0 0",
                  "spread 2", "dump", "strength loud", "strength 20", "bias 0 1",
                  "bias nobody 1 2 3", "spread 0", "obs 1 2 3", "gauss 1"},
                 patch.map);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  const auto info = run.recorded("info");
  for (const std::string& line :
       {std::string("decoder lag 0.1"), std::string("rate 60"), std::string("memory 2"),
        std::string("margin 0.2"), std::string("hold 0.5"), std::string("timeout 1"),
        std::string("onlost walk 4"), "mask " + joint + " 0"})
    EXPECT_TRUE(says(info, line)) << line;
  const std::vector<std::string> settings{"strength 0.5", "strength 2 2", "bias 2 0.25 0 0",
                                          "spread 2"};
  EXPECT_EQ(run.recorded("distance"), settings);
  const auto said = [&](const std::string& text) {
    EXPECT_NE(run.log.find(text), std::string::npos) << text << "\n" << run.log;
  };
  said("gait.viterbi~: in: expected " + std::to_string(demo()->input.values) + " numbers, got 3");
  said("gait.viterbi~: decoder: expected viterbi, forward or lag, got 'best'");
  said("gait.viterbi~: mask: no input 'nobody'; there are ");
  said("gait.viterbi~: onlost: expected walk or stop, got 'fly'");
  said("gait.map: strength: expected a number, got 'loud'");
  said("gait.map: strength: expected a number from -10 to 10, got 20");
  said("gait.map: bias: no output 'nobody'; there are ");
  said("gait.map: obs: expected ");
  EXPECT_EQ(run.errors().size(), 18u) << "the second frame of a wrong size is not said at once\n"
                                      << run.log;
}

TEST(ViterbiObject, with_the_map_allocates_nothing_while_frames_come) {
  GAIT_NEEDS_PD();
  if (!can_watch()) GTEST_SKIP() << "the sanitizer has an allocator of its own";
  const Eigen::MatrixXf inputs = inputs_of(unseen_walk("sad"));
  Patch patch;
  patch.object("gait.model gait-demo -blocking");
  const int watch = patch.object("watch"), viterbi = patch.object("gait.viterbi~ gait-demo"),
            map = patch.object("gait.map gait-demo");
  patch.connect(viterbi, 4, map);
  std::vector<std::string> frames;
  for (int frame = 0; frame < inputs.cols(); ++frame)
    frames.push_back(message_of("in", inputs.col(frame)));
  patch.at_start({"rate 60"}, viterbi);
  patch.at_start(frames, viterbi);  // buffers grow once
  patch.at_start({"1"}, watch);
  patch.at_start(frames, viterbi);
  patch.at_start({"joint 0 0.1 0.1 0.1", "quat 1 0 0 0 1", "euler 2 ZXY 1 2 3", "bang"}, viterbi);
  patch.at_start(frames, viterbi);
  patch.at_start({"0"}, watch);
  patch.quit_after(10);
  const PdRun run = run_pd(patch, {.home = "", .watched = true});
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(watched_allocations(run), 0) << run.log;
}

TEST(ViterbiObject, many_in_a_clone_do_as_one_alone) {
  GAIT_NEEDS_PD();
  const Eigen::MatrixXf inputs = inputs_of(unseen_walk("heavy")).leftCols(60);
  std::ofstream(::testing::TempDir() + "gait_chain.pd")
      << "#N canvas 0 0 400 300 12;\n#X obj 10 10 inlet;\n#X obj 10 40 gait.viterbi~ gait-demo;\n"
         "#X obj 10 70 gait.map gait-demo;\n#X obj 10 100 outlet;\n#X connect 0 0 1 0;\n"
         "#X connect 1 4 2 0;\n#X connect 2 0 3 0;\n";
  ChainPatch patch;
  const int clone = patch.object("clone " + ::testing::TempDir() + "gait_chain 3");
  patch.record(clone, 0, "cloned");
  std::vector<std::string> alone{"rate 30"}, numbered{"all rate 30"};
  for (int frame = 0; frame < inputs.cols(); ++frame) {
    alone.push_back(message_of("in", inputs.col(frame)));
    for (const char* number : {"0 ", "2 "}) numbered.push_back(number + alone.back());
  }
  patch.at_start(alone, patch.viterbi);
  patch.at_start(numbered, clone);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  std::vector<std::string> expected, found[3];
  for (const std::string& line : run.recorded("gauss"))
    if (line.starts_with("gauss ")) expected.push_back(line);
  for (const std::string& line : run.recorded("cloned")) {
    // list NUMBER gauss ...
    std::istringstream words(line);
    std::string list;
    int number = -1;
    words >> list >> number >> std::ws;
    std::string rest;
    std::getline(words, rest);
    ASSERT_TRUE(number >= 0 && number < 3) << line;
    if (rest.starts_with("gauss ")) found[number].push_back(rest);
  }
  ASSERT_EQ(expected.size(), 60u);
  EXPECT_EQ(found[0], expected);
  EXPECT_TRUE(found[1].empty());
  EXPECT_EQ(found[2], expected);
}

TEST(ViterbiObject, refuses_flags_that_it_or_this_pd_does_not_know) {
  GAIT_NEEDS_PD();
  Patch patch;
  for (const char* flags :
       {"gait-demo -signals", "gait-demo -signals 0", "gait-demo -loud", "gait-demo more"})
    patch.object(std::string("gait.viterbi~ ") + flags);
  patch.object("gait.map gait-demo more");
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  for (const char* text : {"gait.viterbi~: expected a whole number from 1 to 512, got 0",
                           "gait.viterbi~: expected -signals N or -mc, got '-loud'",
                           "gait.viterbi~: expected -signals N or -mc, got 'more'",
                           "gait.map: expected 0 to 1 argument"})
    EXPECT_NE(run.log.find(text), std::string::npos) << text << "\n" << run.log;
}

}  // namespace
}  // namespace gait::testing
