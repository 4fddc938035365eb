// [gait.viterbi~] on stage: frames that jitter and get lost, streams that stop and come back,
// people who stand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "patches/viterbi_patch.h"

namespace gait::testing {
namespace {

TEST(ViterbiObject, says_where_the_walk_was_when_its_stream_stops_and_takes_it_up_again) {
  GAIT_NEEDS_PD();
  ChainPatch patch;
  const Eigen::MatrixXf inputs = inputs_of(unseen_walk("proud"));
  std::vector<std::pair<double, std::string>> messages;
  for (int frame = 0; frame < 80; ++frame)
    messages.push_back({frame == 0 ? 0.1 : 1 / 30.0, message_of("in", inputs.col(frame))});
  for (int frame = 80; frame < 100; ++frame)
    messages.push_back({frame == 80 ? 1 : 1 / 30.0, message_of("in", inputs.col(frame))});
  patch.play(messages);
  patch.dsp();
  patch.quit_after(6000);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  std::vector<std::string> told;
  for (const std::string& line : run.recorded("gauss")) {
    if (line.starts_with("gauss")) continue;
    const std::string word = line.starts_with("place") ? "place" : line;
    if (told.empty() || told.back() != word || word != "place") told.push_back(word);
  }
  const std::vector<std::string> expected{"stream 1", "walking 1", "place", "stream 0",
                                          "stream 1", "walking 1", "place", "stream 0"};
  EXPECT_EQ(told, expected);
  const auto places = run.numbers("cord", "place");
  // For two seconds with the frames of either stream, and when it stops.
  ASSERT_EQ(places.size(), 60u + 1 + 20 + 1);
  const Computed core = computed(inputs.leftCols(80), 1);
  const auto expect_place = [&](const std::vector<double>& place, int frame, double later) {
    ASSERT_EQ(place.size(), 2 + demo()->styles.size());
    const Decision& decision = core.decisions[frame];
    EXPECT_NEAR(place[1], decision.cadence, 0.15);
    EXPECT_NEAR(std::remainder(place[0] - (decision.phase + later * decision.cadence / 2), 1), 0,
                0.06);
    for (std::size_t style = 0; style < demo()->styles.size(); ++style)
      EXPECT_NEAR(place[2 + style], core.styles[frame][style], 0.02);
  };
  for (const int frame : {0, 30, 59}) expect_place(places[frame], frame, 0);
  // It has gone on for the quarter second that was waited.
  expect_place(places[60], 79, 0.25);
}

TEST(ViterbiObject, feet_touch_on_time_though_frames_jitter_and_some_are_lost) {
  GAIT_NEEDS_PD();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const std::string& style : demo()->styles) {
    std::vector<double> late;
    int contacts = 0, on_time = 0;
    const CorpusWalk walk = unseen_walk(style, 24);
    const Eigen::MatrixXf inputs = inputs_of(walk);
    ChainPatch patch;
    // The ramp, read every block, and when each foot touches.
    const int clock = patch.object("metro 1.3333333"), read = patch.object("snapshot~"),
              begin = patch.object("loadbang"), contact = patch.object("route contact"),
              foot = patch.object("route right left");
    patch.connect(begin, 0, clock);
    patch.connect(clock, 0, read);
    patch.connect(patch.viterbi, 0, read);
    patch.record(read, 0, "ramp");
    patch.connect(patch.viterbi, 5, contact);
    patch.connect(contact, 0, foot);
    for (int side = 0; side < 2; ++side) {
      const int timer = patch.object("timer");
      patch.connect(begin, 0, timer);
      patch.connect(foot, side, timer, 1);
      patch.record(timer, 0, side == 0 ? "right" : "left");
    }
    std::vector<std::pair<double, std::string>> messages{{0, "rate 30"}};
    double before = 0;
    for (int frame = 0; frame < inputs.cols(); ++frame) {
      if (frame > 0 && uniform(random) > 0.9) continue;
      const double time = std::max(before, 0.1 + frame / 30.0 + 0.02 * uniform(random));
      messages.push_back({time - before, message_of("in", inputs.col(frame))});
      before = time;
    }
    patch.play(messages);
    patch.dsp();
    patch.quit_after(1000 * before + 100);
    const PdRun run = run_pd(patch);
    ASSERT_EQ(run.exit_code, 0) << run.log;
    EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;

    const auto ramp = run.numbers("ramp", "float");
    ASSERT_GT(ramp.size(), 1000u);
    const double settled = 0.1 + walk.contacts[2].frame / 30.0;
    double steepest = 0, sum = 0;
    int steps = 0;
    for (auto i = static_cast<std::size_t>(settled * 750); i + 1 < ramp.size(); ++i, ++steps) {
      double step = ramp[i + 1][0] - ramp[i][0];
      if (step < -0.5) step += 1;
      EXPECT_GE(step, 0) << style;
      steepest = std::max(steepest, step), sum += step;
    }
    EXPECT_LT(steepest, 3 * sum / steps) << style;
    for (const Contact& made : walk.contacts) {
      const double time = 0.1 + made.frame / 30.0;
      if (time < settled || time + 0.1 > before) continue;
      double nearest = 1e9;
      for (const auto& heard : run.numbers(made.foot == Foot::right ? "right" : "left", "float")) {
        const double off = heard[0] / 1000 - time;
        if (std::abs(off) < std::abs(nearest)) nearest = off;
      }
      ++contacts;
      on_time += std::abs(nearest) <= 2 / 30.0;
      late.push_back(nearest * 30);
    }
    std::nth_element(late.begin(), late.begin() + late.size() / 2, late.end());
    const double median = late[late.size() / 2];
    std::printf("%s: %d of %d contacts within two frames, median %.2f frames late, steepest %.2f\n",
                style.c_str(), on_time, contacts, median, steepest / (sum / steps));
    EXPECT_GT(contacts, 40) << style;
    EXPECT_GE(on_time, 0.95 * contacts) << style;
    EXPECT_LE(std::abs(median), 1) << style;
  }
}

TEST(ViterbiObject, who_stands_makes_no_steps_and_no_phase) {
  GAIT_NEEDS_PD();
  ChainPatch patch;
  const Eigen::MatrixXf inputs = inputs_of(unseen_walk("cool"));
  std::vector<std::pair<double, std::string>> messages;
  for (int frame = 0; frame < 200; ++frame)
    messages.push_back({1 / 30.0, message_of("in", inputs.col(std::min(frame, 80)))});
  patch.play(messages);
  patch.dsp();
  patch.quit_after(7000);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  const auto info = run.recorded("info");
  const auto stood = std::ranges::find(info, "walking 0");
  ASSERT_NE(stood, info.end());
  // Counted in frames from the last that moved.
  const auto frames =
      std::count_if(info.begin(), stood, [](const auto& l) { return l.starts_with("phase "); });
  EXPECT_LE(frames, 81 + 30);
  int later = 0;
  std::string phase;
  for (auto line = stood; line != info.end(); ++line) {
    EXPECT_FALSE(line->starts_with("step ") || line->starts_with("contact ")) << *line;
    if (!line->starts_with("phase ") || ++later < 15) continue;
    if (!phase.empty()) {
      EXPECT_EQ(*line, phase);
    }
    phase = *line;
  }
  EXPECT_GT(later, 50);
}

TEST(ViterbiObject, stops_when_its_stream_is_lost_if_it_is_told_so) {
  GAIT_NEEDS_PD();
  const Eigen::MatrixXf inputs = inputs_of(unseen_walk("proud"));
  std::vector<std::pair<double, std::string>> frames{{0, ""}};
  for (int frame = 0; frame < 90; ++frame)
    frames.push_back({1 / 30.0, message_of("in", inputs.col(frame))});
  const double lost = 3.25;
  for (const auto& [told, from, to] : std::vector<std::tuple<std::string, double, double>>{
           {"onlost walk", 1e9, 1e9},
           {"onlost stop", lost, lost + 0.5},
           {"onlost stop 1", lost + 1, lost + 1.5},
           {"onlost walk 2", lost + 2, lost + 2.5}}) {
    ChainPatch patch;
    frames.front().second = told;
    patch.play(frames);
    const int clock = patch.object("metro 10"), read = patch.object("snapshot~"),
              begin = patch.object("loadbang");
    patch.connect(begin, 0, clock);
    patch.connect(clock, 0, read);
    patch.connect(patch.viterbi, 1, read);
    patch.record(read, 0, "cadence");
    patch.dsp();
    patch.quit_after(8000);
    const PdRun run = run_pd(patch);
    ASSERT_EQ(run.exit_code, 0) << run.log;
    EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
    const auto cadence = run.numbers("cadence", "float");
    ASSERT_GT(cadence.size(), 780u);
    for (std::size_t i = 100; i < cadence.size(); ++i) {
      const double time = static_cast<double>(i) / 100;
      EXPECT_TRUE(time >= from || cadence[i][0] > 0.5) << told << " " << time;
      EXPECT_TRUE(time <= to || cadence[i][0] == 0) << told << " " << time;
    }
  }
}

// Nothing steps before somebody walks, whatever else happens to the object.
TEST(ViterbiObject, nobody_steps_before_a_frame_came) {
  GAIT_NEEDS_PD();
  const std::vector<std::vector<std::string>> nobody = {
      {}, {"reset"}, {"model gait-demo"}, {"decoder forward"}, {"resend", "timeout 0.1"}};
  for (const auto& messages : nobody) {
    ChainPatch patch;
    const int ramp = patch.object("snapshot~"), begin = patch.object("loadbang"),
              metro = patch.object("metro 50");
    patch.connect(patch.viterbi, 0, ramp);
    patch.connect(begin, 0, metro);
    patch.connect(metro, 0, ramp);
    patch.record(ramp, 0, "ramp");
    patch.at_start(messages, patch.viterbi);
    patch.dsp();
    patch.quit_after(3000);
    const PdRun run = run_pd(patch);
    ASSERT_EQ(run.exit_code, 0) << run.log;
    for (const std::string& line : run.recorded("info"))
      EXPECT_EQ(line, "stream 0") << "it was asked";
    ASSERT_GT(run.numbers("ramp", "float").size(), 50u);
    for (const auto& phase : run.numbers("ramp", "float")) ASSERT_EQ(phase[0], 0);
  }
}

// A walk that stopped with its stream stays so, though it is reset or another model comes.
TEST(ViterbiObject, nobody_steps_on_after_the_walk_stopped) {
  GAIT_NEEDS_PD();
  const Eigen::MatrixXf inputs = inputs_of(unseen_walk("cool"));
  for (const std::string what : {"reset", "model gait-demo", "decoder forward"}) {
    ChainPatch patch;
    std::vector<std::pair<double, std::string>> messages{{0, "onlost stop"}};
    for (int frame = 0; frame < 60; ++frame)
      messages.push_back({1 / 30.0, message_of("in", inputs.col(frame))});
    messages.push_back({1, what});
    patch.play(messages);
    patch.dsp();
    patch.quit_after(6000);
    const PdRun run = run_pd(patch);
    ASSERT_EQ(run.exit_code, 0) << run.log;
    const auto info = run.recorded("info");
    const auto stopped = std::ranges::find(info, "stream 0");
    ASSERT_NE(stopped, info.end());
    EXPECT_GT(std::count(info.begin(), stopped, "contact right"), 0);
    // While it comes to rest, a foot may still touch.
    const auto is_contact = [](const auto& line) { return line.starts_with("contact"); };
    EXPECT_LE(std::count_if(stopped, info.end(), is_contact), 1) << what;
  }
}

TEST(ViterbiObject, tells_of_contacts_without_sound_too) {
  GAIT_NEEDS_PD();
  const CorpusWalk walk = unseen_walk("proud");
  const Eigen::MatrixXf inputs = inputs_of(walk);
  std::vector<std::pair<double, std::string>> frames;
  for (int frame = 0; frame < inputs.cols(); ++frame)
    frames.push_back({1 / 30.0, message_of("in", inputs.col(frame))});
  ChainPatch patch;
  patch.play(frames);
  patch.quit_after(1000 * (static_cast<double>(inputs.cols()) / 30 + 0.1));
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  int told = 0;
  std::string before;
  for (const std::string& line : run.recorded("info")) {
    if (!line.starts_with("contact ")) continue;
    EXPECT_NE(line, before) << "right and left in turn";
    before = line;
    ++told;
  }
  EXPECT_NEAR(told, static_cast<double>(walk.contacts.size()), 2);
}

}  // namespace
}  // namespace gait::testing
