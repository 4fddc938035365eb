// [gait.synth]: fed and alone it sends what the core synthesises, and goes from one to the other.
#include <gtest/gtest.h>

#include "gait/play/synthesise/synthesiser.h"
#include "patches/patch.h"
#include "patches/walked_messages.h"

namespace gait::testing {
namespace {

const std::vector<Told>& sad_walk() {
  static const std::vector<Told> told = told_gaussians(demo(), walked_streams("sad").in);
  return told;
}

struct SynthPatch : Patch {
  int synth;
  explicit SynthPatch(const std::string& arguments = "gait-demo") {
    object("gait.model gait-demo -blocking");
    synth = object("gait.synth " + arguments);
    record(synth, 0, "out");
    record(synth, 1, "info");
  }
};

PdRun run_without_errors(const Patch& patch) {
  PdRun run = run_pd(patch);
  EXPECT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  return run;
}

int style_number(const std::string& name) {
  const auto& styles = demo()->styles;
  return static_cast<int>(std::ranges::find(styles, name) - styles.begin());
}

void expect_the_cores_frames(const std::string& past_message, int past) {
  const int lag = 2, future = 3;
  SynthPatch patch;
  std::vector<std::string> messages{"future 3", past_message, "stream 1", "walking 1"};
  for (int i = 0; i < 50; ++i)
    messages.push_back(gauss_message(sad_walk()[static_cast<std::size_t>(i)], lag));
  messages.insert(messages.end(), {"resend", "future 1"});
  messages.push_back(gauss_message(sad_walk()[50], lag));
  patch.at_start(messages, patch.synth);
  patch.quit_after(10);
  const PdRun run = run_without_errors(patch);

  Synthesiser synthesiser(demo(), {past, future});
  const auto outputs = run.numbers("out", "out");
  ASSERT_EQ(outputs.size(), 51u - future);
  std::size_t made = 0;
  for (int i = 0; i < 50; ++i) {
    const Told& told = sad_walk()[static_cast<std::size_t>(i)];
    if (!synthesiser.push(told.means, told.variances)) continue;
    expect_near(outputs[made++], synthesiser.outputs());
  }
  EXPECT_EQ(run.numbers("out", "pose").size(), 0u);
  EXPECT_EQ(run.numbers("out", "delay"),
            (std::vector<std::vector<double>>{{lag + future}, {lag + future}, {lag + 1}}));
  // Passed on as they came, before all others.
  const auto lines = run.recorded("out");
  EXPECT_EQ(lines[0], "stream 1");
  EXPECT_EQ(lines[1], "walking 1");
  EXPECT_EQ(lines[2], "delay 5");
}

TEST(SynthObject, sends_the_cores_frames_for_gaussians) {
  GAIT_NEEDS_PD();
  expect_the_cores_frames("past 12", 12);
  expect_the_cores_frames("past all", whole_past);
}

TEST(SynthObject, walks_alone_as_the_core_does) {
  GAIT_NEEDS_PD();
  SynthPatch patch;
  std::vector<std::string> messages{"style sad", "cadence 2", "joint Head scale 2",
                                    "duration scale 1.1", "left"};
  for (int i = 0; i < 60; ++i) messages.push_back("bang");
  messages.insert(messages.end(), {"advance 0.05", "advance 0.05"});  // three frames
  patch.at_start(messages, patch.synth);
  patch.quit_after(10);
  const PdRun run = run_without_errors(patch);

  StepWalker walker(demo());
  walker.set_style(style_number("sad"));
  walker.durations().set_cadence(2);
  walker.durations().set_scale(1.1f);
  walker.streams().set_scale(walker.stream_of(demo()->body->skeleton.find("Head")), 2);
  walker.queue(1);
  const auto poses = run.numbers("out", "pose");
  ASSERT_EQ(poses.size(), 63u);
  std::vector<std::string> steps;
  for (std::size_t frame = 0; frame < poses.size(); ++frame) {
    walker.advance();
    const Body& body = *demo()->body;
    for (std::size_t i = 0; i < body.input_joints.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(poses[frame][3 * static_cast<std::size_t>(body.input_joints[i]) + axis],
                    walker.inputs()[3 * i + axis], 1e-6);
    for (std::size_t i = 0; i < body.output_joints.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(poses[frame][3 * static_cast<std::size_t>(body.output_joints[i]) + axis],
                    walker.outputs()[3 * i + axis], 1e-6);
    EXPECT_NEAR(run.numbers("info", "phase")[frame][0], walker.phase(), 1e-6);
    EXPECT_NEAR(run.numbers("info", "cadence")[frame][0], walker.cadence(), 1e-6);
    if (walker.entered())
      steps.push_back("step " + demo()->labels[static_cast<std::size_t>(*walker.entered())].name);
  }
  std::vector<std::string> said;
  for (const std::string& line : run.recorded("info"))
    if (line.starts_with("step ")) said.push_back(line);
  EXPECT_EQ(said, steps);
  EXPECT_EQ(said.front(), "step left");
  EXPECT_EQ(run.numbers("info", "queue"), (std::vector<std::vector<double>>{{1}, {0}}));
}

TEST(SynthObject, goes_on_by_its_own_clock_when_the_stream_is_lost_and_comes_back_to_it) {
  GAIT_NEEDS_PD();
  for (const std::string how : {"walk", "hold", "stop"}) {
    SynthPatch patch;
    std::vector<std::string> messages{"onlost " + how, "stream 1"};
    for (std::size_t i = 0; i < 50; ++i) messages.push_back(gauss_message(sad_walk()[i]));
    messages.push_back(place_message(sad_walk()[49]));
    messages.push_back("stream 0");
    patch.at_start(messages, patch.synth);
    // A second later.
    const int begin = patch.object("loadbang"), later = patch.object("delay 990");
    patch.connect(begin, 0, later);
    messages = {"stream 1"};
    for (std::size_t i = 50; i < 110; ++i) messages.push_back(gauss_message(sad_walk()[i]));
    for (const std::string& text : messages) {
      const int box = patch.message(text);
      patch.connect(later, 0, box);
      patch.connect(box, 0, patch.synth);
    }
    patch.quit_after(1500);
    const PdRun run = run_without_errors(patch);
    const auto outputs = run.numbers("out", "out"), poses = run.numbers("out", "pose");
    const auto lines = run.recorded("out");
    if (how == "walk") {
      // Thirty frames in the second, those until it goes over, then outputs again.
      EXPECT_GE(poses.size(), 40u);
      EXPECT_EQ(poses.size() + outputs.size(), 110u + 30);
      EXPECT_GT(run.numbers("info", "phase").size(), 30u);
    } else if (how == "hold") {
      EXPECT_EQ(poses.size(), 0u);
      EXPECT_EQ(outputs.size(), 110u + 30);
      EXPECT_EQ(outputs[78], outputs[79]);
    } else {
      EXPECT_EQ(poses.size(), 0u);
      EXPECT_GE(outputs.size(), 95u);
      EXPECT_LE(outputs.size(), 101u);
    }
    EXPECT_EQ(std::ranges::count(lines, "stream 0"), 1);
    // `place` is for this object alone: the next one would take it for a place in the world.
    for (const std::string& line : lines) EXPECT_FALSE(line.starts_with("place")) << line;
    Synthesiser fed(demo());
    for (std::size_t i = 50; i < 110; ++i) fed.push(sad_walk()[i].means, sad_walk()[i].variances);
    expect_near(outputs.back(), fed.outputs(), 1e-4);
  }
}

TEST(SynthObject, goes_over_without_a_jump_when_a_cord_was_shut) {
  GAIT_NEEDS_PD();
  SynthPatch patch;
  const int spigot = patch.object("spigot 1");
  patch.connect(spigot, 0, patch.synth);
  // One message a frame, by delays; the cord is shut from the 40th to the 75th.
  const int begin = patch.object("loadbang");
  for (int i = 0; i < 110; ++i) {
    const int delay = patch.object("delay " + std::to_string(33.3333 * (i + 1)));
    patch.connect(begin, 0, delay);
    if (i == 40 || i == 75) {
      const int gate = patch.message(i == 40 ? "0" : "1");
      patch.connect(delay, 0, gate);
      patch.connect(gate, 0, spigot, 1);
    }
    const int box = patch.message(gauss_message(sad_walk()[static_cast<std::size_t>(i)]));
    patch.connect(delay, 0, box);
    patch.connect(box, 0, spigot);
  }
  patch.quit_after(4000);
  const PdRun run = run_without_errors(patch);
  const auto outputs = run.numbers("out", "out");
  ASSERT_EQ(outputs.size(), 75u);
  double usual = 0, at_cut = 0;
  for (std::size_t i = 1; i < outputs.size(); ++i)
    for (std::size_t value = 0; value < outputs[i].size(); ++value) {
      double& most = i >= 40 && i < 56 ? at_cut : usual;
      most = std::max(most, std::abs(outputs[i][value] - outputs[i - 1][value]));
    }
  std::printf("largest step of a value %.3f rad, %.3f after the cord was shut\n", usual, at_cut);
  EXPECT_LE(at_cut, 1.3 * usual);
}

TEST(SynthObject, keeps_what_it_is_told_before_there_is_a_model) {
  GAIT_NEEDS_PD();
  Patch patch;
  const int synth = patch.object("gait.synth other"),
            model = patch.object("gait.model other -blocking");
  patch.record(synth, 0, "out");
  patch.record(synth, 1, "info");
  patch.at_start({"style sad", "left", "joint Head fix 0.1 0 0", "joint Nose scale 2", "bang",
                  "bang", "start", "stop"},
                 synth);
  patch.at_start({std::string("read ") + GAIT_PD_FOLDER + "/gait-demo.gait"}, model);
  patch.at_start({"bang", "perf", "dump"}, synth);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_NE(run.log.find("gait.synth: waiting for other"), std::string::npos) << run.log;
  EXPECT_NE(run.log.find("gait.synth: joint: no joint 'Nose'"), std::string::npos) << run.log;
  StepWalker walker(demo());
  walker.set_style(style_number("sad"));
  walker.queue(1);
  walker.advance();
  const auto poses = run.numbers("out", "pose");
  ASSERT_EQ(poses.size(), 1u);
  const int head = demo()->body->skeleton.find("Head");
  EXPECT_NEAR(poses[0][static_cast<std::size_t>(3 * head)], 0.1, 1e-6);
  const int first = demo()->body->output_joints[0];
  EXPECT_NEAR(poses[0][static_cast<std::size_t>(3 * first)], walker.outputs()[0], 1e-6);
  EXPECT_EQ(run.numbers("info", "perf").back()[3], 2);  // dropped
  const auto info = run.recorded("info");
  for (const char* line : {"ready other", "style sad 1", "joint Head fix 0.1 0 0", "auto 1",
                           "onlost walk", "cadence 0"})
    EXPECT_TRUE(says(info, line)) << line;
}

TEST(SynthObject, says_every_frame_as_a_body_or_as_outputs_when_told_so) {
  GAIT_NEEDS_PD();
  SynthPatch patch;
  std::vector<std::string> messages{"body pose"};
  for (std::size_t i = 0; i < 5; ++i) messages.push_back(gauss_message(sad_walk()[i]));
  messages.insert(messages.end(), {"reset", "body out", "bang", "bang", "1", "0", "stop"});
  patch.at_start(messages, patch.synth);
  patch.quit_after(10);
  const PdRun run = run_without_errors(patch);
  EXPECT_EQ(run.numbers("out", "pose").size(), 5u);
  EXPECT_EQ(run.numbers("out", "out").size(), 2u);
}

TEST(SynthObject, refuses_what_it_cannot_use_with_one_line_each) {
  GAIT_NEEDS_PD();
  SynthPatch patch;
  Told broken = sad_walk()[0];
  broken.variances[0] = -1;
  const std::vector<std::string> bad{"gauss 0 3 1 2 3",
                                     "stream maybe",
                                     "walking 2",
                                     "place 0.5 loud",
                                     "auto 5",
                                     "duration scale loud",
                                     "duration 3",
                                     "duration fix 0.01",
                                     "cadence -1",
                                     "joint Nose free",
                                     "joint 999 scale 2",
                                     "joint Head shift 1",
                                     "joint Head jump 1",
                                     "past -1",
                                     "past some",
                                     "future 0.5",
                                     "future 1000",
                                     "onlost run",
                                     "body both",
                                     "style nobody",
                                     "weight sad -1",
                                     "jump",
                                     "jump 3",
                                     "12",
                                     "advance -1"};
  patch.at_start(bad, patch.synth);
  patch.at_start({gauss_message(broken), gauss_message(sad_walk()[0])}, patch.synth);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  // Frames speak once a second at most: the broken one and the place come right after the first.
  EXPECT_EQ(run.errors().size(), bad.size() - 2) << run.log;
  const auto said = [&](const std::string& text) {
    EXPECT_NE(run.log.find(text), std::string::npos) << text << "\n" << run.log;
  };
  said("gait.synth: gauss: expected ");
  said("gait.synth: duration: expected a number, got 'loud'");
  said("gait.synth: joint: no joint 'Nose'; there are ");
  said("gait.synth: onlost: expected walk, hold or stop, got 'run'");
  said("gait.synth: body: expected out or pose, got 'both'");
  said("gait.synth: jump: no such message, nor a label of gait-demo, which has right, left");
  Synthesiser synthesiser(demo());
  synthesiser.push(sad_walk()[0].means, sad_walk()[0].variances);
  ASSERT_EQ(run.numbers("out", "out").size(), 1u);
  expect_near(run.numbers("out", "out")[0], synthesiser.outputs());
}

TEST(SynthObject, allocates_nothing_at_frame_rate) {
  GAIT_NEEDS_PD();
  if (!can_watch()) GTEST_SKIP() << "the sanitizer has an allocator of its own";
  Patch patch;
  patch.object("gait.model gait-demo -blocking");
  const int watch = patch.object("watch"), synth = patch.object("gait.synth");
  const auto frames = [](std::size_t from, std::size_t to) {
    std::vector<std::string> messages;
    for (std::size_t i = from; i < to; ++i) messages.push_back(gauss_message(sad_walk()[i]));
    return messages;
  };
  patch.at_start(frames(0, 40), synth);  // buffers grow once
  patch.at_start({"bang", "bang"}, synth);
  patch.at_start(frames(40, 60), synth);
  patch.at_start({"1"}, watch);
  patch.at_start(frames(60, 80), synth);
  patch.at_start({place_message(sad_walk()[79]), "stream 0", "bang", "bang", "right", "advance 0.1",
                  "stream 1"},
                 synth);
  patch.at_start(frames(80, 110), synth);
  patch.at_start({"0"}, watch);
  patch.quit_after(10);
  const PdRun run = run_pd(patch, {.home = "", .state = "", .watched = true});
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(watched_allocations(run), 0) << run.log;
}

}  // namespace
}  // namespace gait::testing
