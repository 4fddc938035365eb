// What comes in is recorded, and can be played and written.
#include "gait/play/clips/pose_recorder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "gait/corpus/demo_motion.h"
#include "gait/play/clips/clip_player.h"
#include "play/few_walks.h"
#include "play/forbidden_memory.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::ForbiddenMemory;
using testing::plan_of;

BodyMotion sad_walk() { return demo_motion("gait-demo:sad", *few_walks_model()); }

struct Told {
  std::vector<float> in, out, pose;
  Eigen::Vector3f hips;
  float heading;
};

// Frame after frame, as cords would carry it.
std::vector<Told> told(const BodyMotion& motion) {
  const auto model = few_walks_model();
  ClipPlayer player(model);
  player.set_motion(std::make_shared<BodyMotion>(motion));
  std::vector<Told> frames;
  while (player.advance()) {
    const PlayedFrame& frame = player.frame();
    Told one{{frame.inputs.begin(), frame.inputs.end()},
             {},
             {frame.pose.begin(), frame.pose.end()},
             frame.hips,
             frame.heading};
    for (const int joint : model->body->output_joints)
      one.out.insert(one.out.end(), one.pose.begin() + 3 * joint, one.pose.begin() + 3 * joint + 3);
    frames.push_back(one);
  }
  return frames;
}

void expect_same(const BodyMotion& a, const BodyMotion& b) {
  ASSERT_EQ(a.frames(), b.frames());
  for (std::size_t i = 0; i < a.rotations.size(); ++i)
    ASSERT_LT(angle_between(a.rotations[i], b.rotations[i]), 1e-5) << i;
  for (int frame = 0; frame < a.frames(); ++frame) {
    EXPECT_LT((a.hips[frame] - b.hips[frame]).norm(), 1e-5);
    EXPECT_NEAR(a.heading[frame], b.heading[frame], 1e-5);
  }
}

TEST(PoseRecorder, keeps_poses_with_their_path_and_finds_the_steps) {
  const BodyMotion walk = sad_walk();
  PoseRecorder recorder(few_walks_model());
  double time = 12;
  for (const Told& frame : told(walk)) {
    EXPECT_TRUE(recorder.take_root(frame.hips, frame.heading));
    EXPECT_TRUE(recorder.take_pose(frame.pose, time));
    time += 1 / 30.0;
  }
  const BodyMotion recorded = recorder.finish().motion("recorded");
  EXPECT_EQ(recorder.frames(), 0);
  EXPECT_EQ(recorded.frame_rate, 30);
  expect_same(recorded, walk);
  // Cut at the contacts, the walk begins and ends with one that cannot be told.
  EXPECT_GE(recorded.contacts.size() + 2, walk.contacts.size());
}

TEST(PoseRecorder, puts_inputs_and_outputs_together) {
  const BodyMotion walk = sad_walk();
  PoseRecorder recorder(few_walks_model());
  for (const Told& frame : told(walk)) {
    recorder.take_root(frame.hips, frame.heading);
    recorder.take_inputs(frame.in, 0);
    recorder.take_outputs(frame.out, 0);
  }
  expect_same(recorder.finish().motion("recorded"), walk);
}

TEST(PoseRecorder, keeps_inputs_alone_at_the_rate_they_came) {
  PoseRecorder recorder(few_walks_model());
  const auto frames = told(sad_walk());
  for (std::size_t i = 0; i < frames.size(); ++i)
    recorder.take_inputs(frames[i].in, static_cast<double>(i) / 60);
  const BodyMotion recorded = recorder.finish().motion("recorded");
  ASSERT_EQ(recorded.frames(), static_cast<int>(frames.size()));
  EXPECT_NEAR(recorded.frame_rate, 60, 1e-6);
  ClipPlayer player(few_walks_model());
  player.set_motion(std::make_shared<BodyMotion>(recorded));
  player.set_speed(0.5);
  for (const Told& frame : frames) {
    ASSERT_TRUE(player.advance());
    for (std::size_t i = 0; i < frame.in.size(); ++i)
      EXPECT_NEAR(player.frame().inputs[i], frame.in[i], 1e-5);
  }
}

TEST(PoseRecorder, lets_the_feet_carry_whoever_has_no_path) {
  const BodyMotion walk = sad_walk();
  PoseRecorder recorder(few_walks_model());
  for (const Told& frame : told(walk)) recorder.take_pose(frame.pose, 0);
  const BodyMotion recorded = recorder.finish().motion("recorded");
  const float way = walk.hips.back().z() - walk.hips.front().z();
  EXPECT_NEAR(recorded.hips.back().z() - recorded.hips.front().z(), way, 0.08 * way);
}

TEST(PoseRecorder, refuses_what_is_no_frame_and_what_is_too_much) {
  PoseRecorder recorder(few_walks_model());
  auto frame = told(sad_walk()).front();
  auto broken = frame.pose;
  broken.pop_back();
  EXPECT_FALSE(recorder.take_pose(broken, 0));
  broken = frame.pose;
  broken[4] = NAN;
  EXPECT_FALSE(recorder.take_pose(broken, 0));
  EXPECT_FALSE(recorder.take_root({NAN, 0, 0}, 0));
  EXPECT_FALSE(recorder.take_inputs(frame.out, 0));
  EXPECT_EQ(recorder.frames(), 0);
  EXPECT_EQ(recorder.finish().motion("nothing").frames(), 0);
  while (recorder.take_pose(frame.pose, 0)) {
  }
  EXPECT_TRUE(recorder.full());
  EXPECT_EQ(recorder.frames(), 3600 * 30);
  recorder.clear();
  EXPECT_TRUE(recorder.take_pose(frame.pose, 0));
}

TEST(PoseRecorder, takes_no_memory_while_it_records) {
  if (!ForbiddenMemory::works()) GTEST_SKIP() << "a sanitizer has malloc";
  const auto model = few_walks_model();
  const std::vector<Told> frames = told(sad_walk());
  const int per_block = static_cast<int>(30 * model->frame_rate), wanted = 2 * per_block + 100;
  PoseRecorder recorder(model);
  for (int take = 0; take < 2; ++take) {
    long allocations = 0, releases = 0;
    bool taken = true;
    for (int i = 0; i < wanted; ++i) {
      // No sender is half a minute ahead of a thread.
      while (i % per_block == 0 && !recorder.prepared())
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const Told& frame = frames[static_cast<std::size_t>(i) % frames.size()];
      const ForbiddenMemory forbidden;
      taken &= recorder.take_root(frame.hips, frame.heading);
      if (i % 2 == 0) {
        taken &= recorder.take_pose(frame.pose, i / 30.0);
      } else {
        taken &= recorder.take_inputs(frame.in, i / 30.0);
        taken &= recorder.take_outputs(frame.out, i / 30.0);
      }
      allocations += forbidden.allocations();
      releases += forbidden.releases();
    }
    EXPECT_TRUE(taken);
    EXPECT_EQ(allocations, 0);
    EXPECT_EQ(releases, 0);
    const BodyMotion recorded = recorder.finish().motion("recorded");
    ASSERT_EQ(recorded.frames(), wanted);
    const std::size_t last = static_cast<std::size_t>(wanted - 1);
    EXPECT_LT((recorded.hips[last] - frames[last % frames.size()].hips).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace gait
