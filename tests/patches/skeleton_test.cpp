// [gait.skeleton]: it shows the body that the core puts on stage.
#include <gtest/gtest.h>

#include "gait/play/body/body_stage.h"
#include "patches/patch.h"
#include "patches/walked_messages.h"

namespace gait::testing {
namespace {

const WalkedStreams& sad() {
  static const WalkedStreams streams = walked_streams("sad");
  return streams;
}

struct SkeletonPatch : Patch {
  int skeleton;
  SkeletonPatch() {
    object("gait.model gait-demo -blocking");
    skeleton = object("gait.skeleton");
    record(skeleton, 0, "figure");
    record(skeleton, 1, "body");
    record(skeleton, 2, "info");
  }
};

void expect_root(const std::vector<double>& sent, const RootPlace& root) {
  ASSERT_EQ(sent.size(), 4u);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(sent[static_cast<std::size_t>(i)], root.hips[i], 1e-5);
  EXPECT_NEAR(sent[3], root.heading, 1e-6);
}

TEST(SkeletonObject, shows_a_whole_body_as_the_core_does) {
  GAIT_NEEDS_PD();
  SkeletonPatch patch;
  std::vector<std::string> messages{"place 1 0.2 3", "heading 0.3", "leg 1.1", "smooth 5",
                                    "report Head 0"};
  const int frames = 60;
  for (int i = 0; i < frames; ++i) messages.push_back(message_of("pose", column(sad().pose, i)));
  patch.at_start(messages, patch.skeleton);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;

  BodyStage stage(demo());
  stage.set_place({1, 0.2f, 3});
  stage.set_heading_rate(0.3f);
  stage.set_leg_length(1.1f);
  stage.set_smooth(5);
  const auto positions = run.numbers("figure", "pos"), poses = run.numbers("body", "pose"),
             roots = run.numbers("body", "root"), energies = run.numbers("info", "energy");
  ASSERT_EQ(positions.size(), static_cast<std::size_t>(frames));
  ASSERT_EQ(poses.size(), positions.size());
  std::vector<std::string> contacts, heard;
  std::vector<double> strides;
  const auto head = static_cast<std::size_t>(demo()->body->skeleton.find("Head"));
  const auto lines = run.recorded("info");
  std::vector<std::string> heads;
  for (const std::string& line : lines) {
    if (line.starts_with("contact ")) heard.push_back(line);
    if (line.starts_with("joint Head ")) heads.push_back(line);
  }
  ASSERT_EQ(heads.size(), positions.size());
  for (int i = 0; i < frames; ++i) {
    const auto at = static_cast<std::size_t>(i);
    stage.show_pose(column(sad().pose, i));
    expect_near(positions[at], stage.positions(), 1e-5);
    expect_near(poses[at], stage.pose());
    expect_root(roots[at], stage.root());
    EXPECT_NEAR(energies[at][0], stage.energy(), 1e-6);
    double x = 0, y = 0, z = 0;
    ASSERT_EQ(std::sscanf(heads[at].c_str(), "joint Head %lf %lf %lf", &x, &y, &z), 3);
    EXPECT_NEAR(y, stage.positions()[3 * head + 1], 1e-5);
    for (const Foot foot : {Foot::right, Foot::left}) {
      if (stage.stride(foot)) strides.push_back(*stage.stride(foot));
      if (stage.touched(foot)) contacts.push_back("contact " + std::string(foot_name(foot)));
    }
  }
  EXPECT_GE(contacts.size(), 2u);
  EXPECT_EQ(heard, contacts);
  const auto said = run.numbers("info", "stride");
  ASSERT_EQ(said.size(), strides.size());
  for (std::size_t i = 0; i < said.size(); ++i) EXPECT_NEAR(said[i][0], strides[i], 1e-5);
  // Bones come before the first places, in pairs.
  const auto figure = run.recorded("figure");
  EXPECT_TRUE(figure[0].starts_with("bones "));
  EXPECT_EQ(run.numbers("figure", "bones").back().size(), 2 * stage.bones().size());
}

TEST(SkeletonObject, puts_outputs_and_the_inputs_they_came_from_together) {
  GAIT_NEEDS_PD();
  for (const std::string cold : {"in", "pose"}) {
    SkeletonPatch patch;
    const int delay = 2, frames = 40;
    patch.at_start({"delay 2", "root keep", "stream 1"}, patch.skeleton);
    for (int i = 0; i < frames; ++i) {
      const std::vector<float> root{0.1f * static_cast<float>(i), 0.9f, 0, 0.01f};
      patch.at_start({message_of("root", root),
                      message_of(cold, column(cold == "in" ? sad().in : sad().pose, i))},
                     patch.skeleton, 1);
      if (i >= delay)
        patch.at_start({message_of("out", column(sad().out, i - delay))}, patch.skeleton);
    }
    patch.quit_after(10);
    const PdRun run = run_pd(patch);
    ASSERT_EQ(run.exit_code, 0) << run.log;
    EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
    const auto poses = run.numbers("body", "pose"), roots = run.numbers("body", "root");
    ASSERT_EQ(poses.size(), static_cast<std::size_t>(frames - delay));
    for (int i = 0; i < frames - delay; ++i) {
      expect_near(poses[static_cast<std::size_t>(i)], column(sad().pose, i));
      EXPECT_NEAR(roots[static_cast<std::size_t>(i)][0], 0.1 * i, 1e-5);
    }
  }
}

TEST(SkeletonObject, stays_where_it_is_while_it_does_not_walk_or_walks_on_the_spot) {
  GAIT_NEEDS_PD();
  SkeletonPatch patch;
  std::vector<std::string> messages;
  for (int i = 0; i < 30; ++i) messages.push_back(message_of("pose", column(sad().pose, i)));
  messages.push_back("walking 0");
  for (int i = 30; i < 60; ++i) messages.push_back(message_of("pose", column(sad().pose, i)));
  messages.insert(messages.end(), {"walking 1", "root still", "reset"});
  for (int i = 0; i < 30; ++i) messages.push_back(message_of("pose", column(sad().pose, i)));
  patch.at_start(messages, patch.skeleton);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto roots = run.numbers("body", "root");
  ASSERT_EQ(roots.size(), 90u);
  EXPECT_GT(roots[29][2], 0.2);
  EXPECT_NEAR(roots[59][2], roots[42][2], 1e-3);
  for (std::size_t i = 60; i < 90; ++i) EXPECT_EQ(roots[i][2], 0);
}

TEST(SkeletonObject, is_restored_by_its_dump_and_says_bones_again_on_request) {
  GAIT_NEEDS_PD();
  SkeletonPatch patch;
  patch.at_start(
      {"root still", "lock 0", "heading 0.5", "place 1 2 3", "smooth 2", "leg 1", "delay 4",
       "walking 0", "report Head 3", "dump", "resend", "print", "perf", "reset"},
      patch.skeleton);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto info = run.recorded("info");
  for (const char* line : {"root still", "lock 0", "heading 0.5", "place 1 2 3", "smooth 2",
                           "leg 1", "delay 4", "walking 0", "report Head 3"})
    EXPECT_NE(std::ranges::find(info, line), info.end()) << line;
  EXPECT_GE(run.numbers("figure", "bones").size(), 1u);
}

TEST(SkeletonObject, holds_feet_until_told_not_to) {
  GAIT_NEEDS_PD();
  SkeletonPatch patch;
  const int frames = 60;
  // A joint off by two in a hundred moves its foot.
  Eigen::MatrixXf poses = sad().pose;
  for (int i = 0; i < frames; ++i) poses.col(i).tail(6) *= 0.98f;
  std::vector<std::string> messages;
  for (const char* lock : {"lock 1", "lock 0"}) {
    messages.insert(messages.end(), {lock, "reset"});
    for (int i = 0; i < frames; ++i) messages.push_back(message_of("pose", column(poses, i)));
  }
  patch.at_start(messages, patch.skeleton);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto shown = run.numbers("body", "pose");
  ASSERT_EQ(shown.size(), 2u * frames);
  double held = 0, free = 0;
  for (int i = 0; i < frames; ++i) {
    const auto sent = column(poses, i);
    for (std::size_t at = 0; at < sent.size(); ++at) {
      const auto off = [&](int frame) {
        return std::abs(shown[static_cast<std::size_t>(frame)][at] - static_cast<double>(sent[at]));
      };
      held = std::max(held, off(i)), free = std::max(free, off(frames + i));
    }
  }
  EXPECT_GT(held, 1e-3);
  EXPECT_LT(free, 1e-6);
}

TEST(SkeletonObject, refuses_what_it_cannot_use_with_one_line_each) {
  GAIT_NEEDS_PD();
  SkeletonPatch patch;
  const std::vector<std::string> bad{"root sideways", "heading loud", "heading 99",  "place 1 2",
                                     "smooth -1",     "leg -1",       "delay 0.5",   "delay 1000",
                                     "walking maybe", "lock tight",   "report Nose", "report 99999",
                                     "jump 3",        "stream 3"};
  patch.at_start(bad, patch.skeleton);
  patch.at_start({"in 1 2 3"}, patch.skeleton, 1);
  patch.at_start({"jump"}, patch.skeleton, 1);
  patch.at_start({"pose 1 2 3", message_of("pose", column(sad().pose, 0))}, patch.skeleton);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  // The same words come once a second at most, of frames and of all else.
  EXPECT_EQ(run.errors().size(), bad.size() + 1) << run.log;
  const auto said = [&](const std::string& text) {
    EXPECT_NE(run.log.find(text), std::string::npos) << text << "\n" << run.log;
  };
  said("gait.skeleton: root: expected feet, keep or still, got 'sideways'");
  said("gait.skeleton: report: no joint 'Nose'; there are ");
  said("gait.skeleton: jump: no such message");
  said("gait.skeleton: in: expected ");
  said("gait.skeleton: jump: no such message at the right inlet");
  EXPECT_EQ(run.numbers("figure", "pos").size(), 1u);
}

TEST(SkeletonObject, allocates_nothing_at_frame_rate) {
  GAIT_NEEDS_PD();
  if (!can_watch()) GTEST_SKIP() << "the sanitizer has an allocator of its own";
  Patch patch;
  patch.object("gait.model gait-demo -blocking");
  const int watch = patch.object("watch"), skeleton = patch.object("gait.skeleton");
  const auto frames = [&](int from, int to) {
    for (int i = from; i < to; ++i) {
      patch.at_start({"root 0 1 0 0", message_of("in", column(sad().in, i))}, skeleton, 1);
      patch.at_start({message_of("out", column(sad().out, i))}, skeleton);
      patch.at_start({message_of("pose", column(sad().pose, i))}, skeleton);
    }
  };
  patch.at_start({"report Head 3", "smooth 3"}, skeleton);
  frames(0, 10);  // buffers grow once
  patch.at_start({"1"}, watch);
  frames(10, 60);
  patch.at_start({"0"}, watch);
  patch.quit_after(10);
  const PdRun run = run_pd(patch, {.home = "", .state = "", .watched = true});
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(watched_allocations(run), 0) << run.log;
}

}  // namespace
}  // namespace gait::testing
