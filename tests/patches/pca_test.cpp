// [gait.pca]: what it sends is what the core's walkers walk, and what it refuses.
#include <gtest/gtest.h>

#include "gait/model/body_pose.h"
#include "gait/play/cycles/speed_walker.h"
#include "gait/play/cycles/style_walker.h"
#include "patches/demo_model.h"
#include "patches/patch.h"

namespace gait::testing {
namespace {

std::vector<float> vectors_of(std::span<const Eigen::Quaternionf> pose) {
  std::vector<Eigen::Quaternionf> references;
  std::vector<int> joints;
  for (const auto& reference : demo()->body->references) {
    joints.push_back(static_cast<int>(joints.size()));
    references.push_back(reference.cast<float>());
  }
  std::vector<float> values(3 * joints.size());
  pose_vector<float>(pose, references, joints, values);
  return values;
}

void expect_near(const std::vector<double>& sent, const std::vector<float>& computed) {
  ASSERT_EQ(sent.size(), computed.size());
  for (std::size_t i = 0; i < sent.size(); ++i) EXPECT_NEAR(sent[i], computed[i], 1e-6) << i;
}

// A patch with the model there at once, and the object.
struct PcaPatch : Patch {
  int pca;
  explicit PcaPatch(const std::string& arguments) {
    object("gait.model gait-demo -blocking");
    pca = object("gait.pca " + arguments);
    record(pca, 0, "out");
    record(pca, 1, "info");
  }
};

TEST(PcaObject, walks_in_a_style_as_the_core_does) {
  GAIT_NEEDS_PD();
  PcaPatch patch("gait-demo style");
  std::vector<std::string> messages{"seed 5", "style sad 0.7 proud 0.3", "variation 0.5",
                                    "score 1 2"};
  for (int i = 0; i < 60; ++i) messages.push_back("bang");
  messages.push_back("phase 0.25");
  patch.at_start(messages, patch.pca);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;

  StyleWalker walker(demo(), 5);
  std::vector<float> weights(demo()->styles.size(), 0);
  for (std::size_t i = 0; i < weights.size(); ++i)
    weights[i] = demo()->styles[i] == "sad" ? 0.7f : demo()->styles[i] == "proud" ? 0.3f : 0;
  walker.set_weights(weights);
  walker.set_variation(0.5f);
  walker.pin(1, 2);
  const auto poses = run.numbers("out", "pose");
  ASSERT_EQ(poses.size(), 61u);
  int contacts = 0;
  for (int i = 0; i < 60; ++i) {
    walker.advance(1 / demo()->frame_rate);
    contacts += walker.contact() ? 1 : 0;
    expect_near(poses[i], vectors_of(walker.pose()));
  }
  walker.scrub(0.25);
  expect_near(poses[60], vectors_of(walker.pose()));
  int told = 0;
  for (const std::string& line : run.recorded("info")) told += line.starts_with("contact ") ? 1 : 0;
  EXPECT_EQ(told, contacts);
  EXPECT_GT(contacts, 1);
}

TEST(PcaObject, walks_at_a_speed_as_the_core_does) {
  GAIT_NEEDS_PD();
  PcaPatch patch("gait-demo speed");
  std::vector<std::string> messages{"speed 1.6", "leg 0.7", "law fitted"};
  for (int i = 0; i < 30; ++i) messages.push_back("advance 0.02");
  patch.at_start(messages, patch.pca);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  SpeedWalker walker(make_speed_tables(*demo()));
  walker.set_speed(1.2f);
  walker.settle();
  walker.set_speed(1.6f);
  walker.set_leg_length(0.7f);
  walker.set_law(SpeedLaw::fitted);
  const auto poses = run.numbers("out", "pose");
  ASSERT_EQ(poses.size(), 30u);
  for (const auto& pose : poses) {
    walker.advance(0.02);
    expect_near(pose, vectors_of(walker.pose()));
  }
  EXPECT_NEAR(run.numbers("out", "leg").back()[0], walker.leg_length(), 1e-6);
}

TEST(PcaObject, projects_a_walk_that_comes_in_and_is_restored_by_its_dump) {
  GAIT_NEEDS_PD();
  PcaPatch patch("gait-demo style");
  const int other = patch.object("gait.pca gait-demo style");
  patch.record(other, 1, "projected");
  patch.connect(patch.pca, 0, other, 1);
  const int contacts = patch.object("route contact"), tell = patch.object("list prepend contact"),
            trim = patch.object("list trim");
  patch.connect(patch.pca, 1, contacts);
  patch.connect(contacts, 0, tell);
  patch.connect(tell, 0, trim);
  patch.connect(trim, 0, other, 1);
  std::vector<std::string> messages{"style heavy", "variation 0"};
  for (int i = 0; i < 200; ++i) messages.push_back("bang");
  messages.push_back("dump");
  patch.at_start(messages, patch.pca);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  EXPECT_EQ(run.errors(), std::vector<std::string>()) << run.log;
  const auto walked = run.numbers("info", "scores"),
             projected = run.numbers("projected", "projected");
  ASSERT_GE(projected.size(), 2u);
  // The other one hears of the contact before the frame it is of: half a frame's difference.
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(projected.back()[i], walked.back()[i], 0.3) << i;
  const auto info = run.recorded("info");
  EXPECT_NE(std::ranges::find(info, "style heavy 1"), info.end());
  EXPECT_NE(std::ranges::find(info, "variation 0"), info.end());
}

TEST(PcaObject, allocates_nothing_while_it_walks) {
  GAIT_NEEDS_PD();
  if (!can_watch()) GTEST_SKIP() << "the sanitizer has an allocator of its own";
  for (const char* kind : {"style", "speed"}) {
    Patch patch;
    patch.object("gait.model gait-demo -blocking");
    const int watch = patch.object("watch"),
              pca = patch.object(std::string("gait.pca gait-demo ") + kind);
    const int other = patch.object(std::string("gait.pca gait-demo ") + kind);
    patch.connect(pca, 0, other, 1);  // projects it
    std::vector<std::string> frames(100, "bang");
    patch.at_start(frames, pca);  // buffers grow once
    patch.at_start({"1"}, watch);
    frames.insert(frames.end(), {"advance 0.3", "phase 0.3"});
    patch.at_start(frames, pca);
    patch.at_start({"0"}, watch);
    patch.quit_after(10);
    const PdRun run = run_pd(patch, {.home = "", .state = "", .watched = true});
    ASSERT_EQ(run.exit_code, 0) << run.log;
    EXPECT_EQ(watched_allocations(run), 0) << run.log;
  }
}

TEST(PcaObject, refuses_what_it_cannot_use_with_one_line_each) {
  GAIT_NEEDS_PD();
  PcaPatch patch("gait-demo style");
  patch.at_start(
      {"bang", "variation loud", "variation 3", "style nobody", "score 999 1", "weight sad",
       "weight sad -1", "jump 3", "advance -1", "free some", "styles 1 2", "5", "bang"},
      patch.pca);
  patch.quit_after(10);
  const PdRun run = run_pd(patch);
  ASSERT_EQ(run.exit_code, 0) << run.log;
  const auto errors = run.errors();
  EXPECT_EQ(errors.size(), 11u) << run.log;
  const auto said = [&](const std::string& text) {
    EXPECT_NE(run.log.find(text), std::string::npos) << text << "\n" << run.log;
  };
  said("gait.pca: variation: expected a number, got 'loud'");
  said("gait.pca: variation: expected a number from 0 to 2, got 3");
  said("gait.pca: style: no style 'nobody' in gait-demo; it has ");
  said("gait.pca: jump: no such message");
  said("gait.pca: list: expected 0 or 1, got 5");
  said("gait.pca: free: expected a score's number or 'all', got 'some'");
  EXPECT_EQ(run.numbers("out", "pose").size(), 2u);
}

}  // namespace
}  // namespace gait::testing
