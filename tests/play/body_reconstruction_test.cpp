#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "gait/error.h"
#include "gait/play/stream_reconstructor.h"
#include "play/few_walks.h"
#include "play/random_model.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::input_poses;
using testing::InputPoses;
using testing::plan_of;

struct Frame {
  double time;
  Decision decision;
  std::vector<float> outputs;
  std::vector<Eigen::Quaternionf> pose;
  Eigen::Vector3f hips;
};

void collect(const StreamReconstructor& reconstructor, std::vector<Frame>& frames) {
  const ReconstructedFrame& frame = reconstructor.frame();
  frames.push_back({frame.time,
                    frame.decision,
                    {frame.outputs.begin(), frame.outputs.end()},
                    {frame.pose.begin(), frame.pose.end()},
                    frame.hips});
}

std::vector<Frame> stream(StreamReconstructor& reconstructor, const InputPoses& poses, double rate,
                          double start = 0) {
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    reconstructor.push(start + static_cast<double>(i) / rate, poses[i]);
    while (reconstructor.next()) collect(reconstructor, frames);
  }
  while (reconstructor.flush()) collect(reconstructor, frames);
  return frames;
}

// On their way through the chain rotations are rotation vectors: the last digit may differ.
bool same_turn(const Eigen::Quaternionf& a, const Eigen::Quaternionf& b) {
  return angle_between<float>(a, b) < 1e-6f;
}

TEST(BodyReconstruction, decides_alike_on_a_walk_sent_at_30_60_and_120_frames_a_second) {
  const auto model = few_walks_model();
  for (const WalkStyle& walked : corpus_styles()) {
    const std::string& style = walked.name;
    std::map<int, std::vector<Frame>> at_rate;
    for (const int rate : {30, 60, 120}) {
      StreamReconstructor reconstructor(model);
      at_rate[rate] = stream(
          reconstructor, input_poses(make_walk(plan_of(style, 9), rate).clip, *model->body), rate);
    }
    for (const int rate : {60, 120}) {
      // The faster stream may end a fraction of a frame later.
      const std::size_t frames = std::min(at_rate[30].size(), at_rate[rate].size());
      ASSERT_GE(frames + 1, at_rate[rate].size());
      int alike = 0;
      for (std::size_t i = 0; i < frames; ++i) {
        const Frame &a = at_rate[30][i], &b = at_rate[rate][i];
        ASSERT_NEAR(a.time, b.time, 1e-6);
        alike += a.decision.label == b.decision.label && a.decision.state == b.decision.state;
      }
      const double share = static_cast<double>(alike) / static_cast<double>(frames);
      EXPECT_GE(share, 0.98) << style << " at " << rate;
      RecordProperty(style + "_" + std::to_string(rate), std::to_string(share));
    }
  }
}

TEST(BodyReconstruction, decides_alike_where_the_senders_frames_lie_between_the_models) {
  const auto model = few_walks_model();
  for (const char* style : {"proud", "drunk"}) {
    StreamReconstructor at_own_rate(model);
    const auto own =
        stream(at_own_rate, input_poses(make_walk(plan_of(style, 9)).clip, *model->body), 30);
    for (const int rate : {50, 72, 100}) {
      StreamReconstructor reconstructor(model);
      const auto other = stream(
          reconstructor, input_poses(make_walk(plan_of(style, 9), rate).clip, *model->body), rate);
      const std::size_t frames = std::min(own.size(), other.size());
      ASSERT_GE(frames + 1, own.size());
      int same_step = 0, same_state = 0;
      for (std::size_t i = 0; i < frames; ++i) {
        const bool step = own[i].decision.label == other[i].decision.label;
        same_step += step;
        same_state += step && own[i].decision.state == other[i].decision.state;
      }
      // Interpolated poses differ a little: a state may begin a frame earlier or later.
      EXPECT_GE(same_step, 0.98 * static_cast<double>(frames)) << style << " at " << rate;
      EXPECT_GE(same_state, 0.94 * static_cast<double>(frames)) << style << " at " << rate;
    }
  }
}

TEST(BodyReconstruction, sees_the_input_joints_and_nothing_else) {
  const auto model = few_walks_model();
  const CorpusWalk walk = make_walk(plan_of("sad", 9));
  Clip noisy = walk.clip;
  const Body& body = *model->body;
  for (int frame = 0; frame < noisy.frames(); ++frame)
    for (const int joint : body.output_joints) {
      noisy.pose(frame)[joint] = Eigen::Quaterniond(Eigen::Vector4d::Random()).normalized();
      noisy.translation(frame)[joint].setRandom();
    }
  StreamReconstructor a(model), b(model);
  const auto clean = stream(a, input_poses(walk.clip, body), 30);
  const auto disturbed = stream(b, input_poses(noisy, body), 30);
  ASSERT_EQ(clean.size(), disturbed.size());
  for (std::size_t i = 0; i < clean.size(); ++i) {
    EXPECT_EQ(clean[i].outputs, disturbed[i].outputs);
    EXPECT_EQ(clean[i].hips, disturbed[i].hips);
    for (std::size_t joint = 0; joint < clean[i].pose.size(); ++joint)
      EXPECT_EQ(clean[i].pose[joint].coeffs(), disturbed[i].pose[joint].coeffs());
  }
}

TEST(BodyReconstruction, leaves_input_joints_as_they_came_and_walks_on) {
  const auto model = few_walks_model();
  const CorpusWalk walk = make_walk(plan_of("proud", 9));
  const InputPoses poses = input_poses(walk.clip, *model->body);
  StreamReconstructor reconstructor(model);
  const auto frames = stream(reconstructor, poses, 30);
  ASSERT_EQ(frames.size(), poses.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_NEAR(frames[i].time, static_cast<double>(i) / 30, 1e-9);
    for (std::size_t j = 0; j < poses[i].size(); ++j)
      EXPECT_TRUE(same_turn(frames[i].pose[model->body->input_joints[j]], poses[i][j]));
    for (const Eigen::Quaternionf& rotation : frames[i].pose) EXPECT_NEAR(rotation.norm(), 1, 1e-4);
  }
  const int begin = walk.contacts.front().frame, end = walk.contacts.back().frame;
  const double walked = (frames[end].hips - frames[begin].hips).norm();
  const double truth = (walk.clip.translation(end)[0] - walk.clip.translation(begin)[0]).norm();
  EXPECT_NEAR(walked / truth, 1, 0.1);
}

TEST(BodyReconstruction, delays_hold_frames_back_but_lose_none) {
  const auto model = few_walks_model();
  const CorpusWalk walk = make_walk(plan_of("drunk", 9));
  const InputPoses poses = input_poses(walk.clip, *model->body);
  for (const double lag : {0.0, 0.2})
    for (const int future : {0, 3}) {
      PlaySettings settings;
      settings.decoder = DecoderKind::lag;
      settings.lag = lag;
      settings.future = future;
      settings.current = future > 0 ? 2 : 1;
      StreamReconstructor reconstructor(model, settings);
      const auto frames = stream(reconstructor, poses, 30);
      ASSERT_EQ(frames.size(), poses.size()) << lag << " " << future;
      for (std::size_t i = 0; i < frames.size(); ++i) {
        EXPECT_NEAR(frames[i].time, static_cast<double>(i) / 30, 1e-9);
        for (std::size_t j = 0; j < poses[i].size(); ++j)
          ASSERT_TRUE(same_turn(frames[i].pose[model->body->input_joints[j]], poses[i][j]))
              << "the pose of the very frame";
      }
    }
}

TEST(BodyReconstruction, begins_anew_after_a_gap_but_stays_where_it_is) {
  const auto model = few_walks_model();
  const InputPoses first = input_poses(make_walk(plan_of("proud", 9)).clip, *model->body);
  const InputPoses second = input_poses(make_walk(plan_of("sad", 9)).clip, *model->body);
  StreamReconstructor interrupted(model), fresh(model);
  const auto before = stream(interrupted, first, 30);
  const auto after = stream(interrupted, second, 30, 100);
  const auto alone = stream(fresh, second, 30, 100);
  ASSERT_EQ(after.size(), alone.size());
  EXPECT_NEAR(after.front().time, 100, 1e-9);
  EXPECT_LT((after.front().hips - before.back().hips).head<1>().norm(), 0.02);
  EXPECT_LT(std::abs(after.front().hips.z() - before.back().hips.z()), 0.02);
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].outputs, alone[i].outputs);
    EXPECT_EQ(after[i].decision.state, alone[i].decision.state);
    EXPECT_LT(((after[i].hips - after[0].hips) - (alone[i].hips - alone[0].hips)).norm(), 1e-3);
  }
}

TEST(BodyReconstruction, a_gap_while_frames_are_held_back_does_not_mix_them) {
  const auto model = few_walks_model();
  PlaySettings settings;
  settings.decoder = DecoderKind::lag;
  settings.lag = 0.2;
  settings.future = 2;
  const InputPoses poses = input_poses(make_walk(plan_of("proud", 9)).clip, *model->body);
  StreamReconstructor reconstructor(model, settings);
  std::vector<Frame> frames;
  for (int run = 0; run < 2; ++run)
    for (int i = 0; i < 60; ++i) {
      reconstructor.push(50 * run + i / 30.0, poses[i]);
      while (reconstructor.next()) collect(reconstructor, frames);
    }
  while (reconstructor.flush()) collect(reconstructor, frames);
  const int delay = reconstructor.delay();
  ASSERT_EQ(frames.size(), 120u - delay) << "what the gap cut off is not played";
  for (int i = 0; i < 60; ++i) {
    EXPECT_NEAR(frames[60 - delay + i].time, 50 + i / 30.0, 1e-9);
    EXPECT_TRUE(same_turn(frames[60 - delay + i].pose[model->body->input_joints[0]], poses[i][0]));
  }
}

TEST(BodyReconstruction, rejects_poses_that_are_none_and_plays_on) {
  const auto model = few_walks_model();
  const InputPoses poses = input_poses(make_walk(plan_of("proud", 9)).clip, *model->body);
  StreamReconstructor reconstructor(model), undisturbed(model);
  using Arrival = FrameClock::Arrival;
  for (int i = 0; i < 40; ++i) {
    const double time = i / 30.0;
    auto wrong = poses[i];
    wrong.pop_back();
    EXPECT_EQ(reconstructor.push(time, wrong), Arrival::rejected);
    wrong = poses[i];
    wrong[2].x() = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(reconstructor.push(time, wrong), Arrival::rejected);
    EXPECT_FALSE(reconstructor.next());
    EXPECT_EQ(reconstructor.push(time, poses[i]), i == 0 ? Arrival::restarted : Arrival::accepted);
    EXPECT_EQ(reconstructor.push(time, poses[i]), Arrival::rejected) << "no time has passed";
    undisturbed.push(time, poses[i]);
    ASSERT_TRUE(reconstructor.next());
    ASSERT_TRUE(undisturbed.next());
    EXPECT_TRUE(std::ranges::equal(reconstructor.frame().outputs, undisturbed.frame().outputs));
  }
}

TEST(BodyReconstruction, a_joint_that_is_lost_after_a_bad_pose_is_held_at_the_last_good_one) {
  const auto model = few_walks_model();
  const InputPoses poses = input_poses(make_walk(plan_of("proud", 9)).clip, *model->body);
  StreamReconstructor reconstructor(model);
  for (int i = 0; i < 20; ++i) {
    reconstructor.push(i / 30.0, poses[i]);
    while (reconstructor.next()) {
    }
  }
  auto bad = poses[20];
  bad[1].w() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(reconstructor.push(20 / 30.0, bad), FrameClock::Arrival::rejected);
  reconstructor.set_missing(1, true);
  EXPECT_EQ(reconstructor.push(20 / 30.0, bad), FrameClock::Arrival::accepted);
  ASSERT_TRUE(reconstructor.next());
  EXPECT_TRUE(same_turn(reconstructor.frame().pose[model->body->input_joints[1]], poses[19][1]));
}

}  // namespace
}  // namespace gait
