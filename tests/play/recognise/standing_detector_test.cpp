// Walking or standing, on the built-in walks and on captured ones, and on people who stand as well
// as figures can: holding a pose with a sensor's noise, swaying slowly.
#include "gait/play/recognise/standing_detector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "play/cycles/styled_walks.h"
#include "play/random_model.h"

namespace gait {
namespace {

using testing::captured_walks;
using testing::corpus_walks;
using testing::StyledWalks;

Eigen::MatrixXf inputs_of(const Clip& clip, const Model& model) {
  const Body& body = *model.body;
  const BodyPoses poses =
      body_poses(clip, body, match_joints(body, clip.skeleton, clip.name), body.heading_window);
  std::vector<double> values(model.input.values);
  Eigen::MatrixXf inputs(model.input.values, poses.frames());
  for (int frame = 0; frame < poses.frames(); ++frame) {
    pose_vector<double>(poses.pose(frame), body.references, body.input_joints, values);
    for (int i = 0; i < model.input.values; ++i) inputs(i, frame) = static_cast<float>(values[i]);
  }
  return inputs;
}

std::span<const float> frame_of(const Eigen::MatrixXf& inputs, Eigen::Index frame) {
  return {inputs.col(frame).data(), static_cast<std::size_t>(inputs.rows())};
}

// A person who stands in a walk's pose: noise of a sensor per value, slow sway, radians.
struct Stance {
  double noise, sway;
};
constexpr Stance stances[] = {{3e-4, 0}, {3e-3, 0}, {3e-4, 0.01}, {3e-3, 0.01}, {1e-3, 0.02}};

Eigen::MatrixXf standing(const Eigen::VectorXf& pose, const Stance& stance, int frames) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Eigen::MatrixXf inputs(pose.size(), frames);
  Eigen::VectorXd size(pose.size()), begin(pose.size());
  for (Eigen::Index i = 0; i < pose.size(); ++i)
    size[i] = stance.sway * 0.7 * normal(random), begin[i] = 6 * normal(random);
  for (int frame = 0; frame < frames; ++frame)
    for (Eigen::Index i = 0; i < pose.size(); ++i)
      inputs(i, frame) = static_cast<float>(
          pose[i] + stance.noise * normal(random) +
          size[i] * std::sin(2 * std::numbers::pi * 0.35 * frame / 30 + begin[i]));
  return inputs;
}

void expect_told_apart(const StyledWalks& walks) {
  const Model& model = *walks.model;
  std::map<std::string, std::pair<int, int>> frames;  // per style: all, and said to be walked
  double slowest_start = 0, slowest_stop = 0;
  for (const Walk& walk : walks.walks) {
    const Eigen::MatrixXf inputs = inputs_of(walk.clip, model);
    StandingDetector detector(model);
    for (Eigen::Index frame = 0; frame < inputs.cols(); ++frame) {
      detector.advance(frame_of(inputs, frame));
      ++frames[walk.style].first;
      frames[walk.style].second += detector.walking();
    }
    // Stops in mid walk, stands, and walks on.
    for (const Stance& stance : stances) {
      const Eigen::MatrixXf still = standing(inputs.col(inputs.cols() - 1), stance, 120);
      int frame = 0;
      while (detector.walking() && frame < still.cols()) detector.advance(frame_of(still, frame++));
      slowest_stop = std::max(slowest_stop, frame / model.frame_rate);
      for (; frame < still.cols(); ++frame)
        ASSERT_FALSE(detector.advance(frame_of(still, frame)))
            << walk.clip.name << " noise " << stance.noise << " sway " << stance.sway;
      frame = 0;
      while (!detector.walking() && frame < inputs.cols())
        detector.advance(frame_of(inputs, frame++));
      slowest_start = std::max(slowest_start, frame / model.frame_rate);
      while (frame < inputs.cols()) detector.advance(frame_of(inputs, frame++));
    }
  }
  EXPECT_LE(slowest_stop, 1) << "seconds";
  EXPECT_LE(slowest_start, 1) << "seconds";
  for (const auto& [style, count] : frames)
    EXPECT_GE(count.second, 0.99 * count.first) << style << " of " << count.first;
}

TEST(StandingDetector, tells_walking_from_standing_in_every_style_of_the_corpus) {
  expect_told_apart(corpus_walks());
}

TEST(StandingDetector, tells_walking_from_standing_in_every_captured_style) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  expect_told_apart(captured_walks());
}

TEST(StandingDetector, a_joint_that_is_lost_or_comes_back_elsewhere_is_no_step) {
  const Model& model = *corpus_walks().model;
  const Eigen::MatrixXf still =
      standing(inputs_of(corpus_walks().walks.front().clip, model).col(0), stances[1], 200);
  StandingDetector detector(model);
  for (int frame = 0; frame < still.cols(); ++frame) {
    Eigen::VectorXf values = still.col(frame);
    if (frame == 80 || frame == 120)
      for (int value = 0; value < 6; ++value) detector.set_missing(value, frame == 80);
    if (frame >= 80 && frame < 120) values.head(6).setConstant(static_cast<float>(frame % 3));
    detector.advance({values.data(), static_cast<std::size_t>(values.size())});
    EXPECT_TRUE(frame <= 30 || !detector.walking()) << frame;
  }
}

TEST(StandingDetector, streams_of_any_unit_count_by_their_own_measure) {
  Model model = testing::random_model();
  const int statics = model.input.statics();
  model.input.lags = {1, 5};
  model.input_scaling.mean.tail(2 * statics).setZero();
  model.input_scaling.deviation.tail(2 * statics).setConstant(0.5);
  // The same in thousandths must not weigh less.
  for (int i = statics; i < 3 * statics; i += statics) model.input_scaling.deviation[i] = 5e-4;
  model.styles.clear();
  StandingDetector detector(model);
  std::vector<float> values(statics, 0.0f);
  for (int frame = 0; frame < 60; ++frame) detector.advance(values);
  EXPECT_FALSE(detector.walking());
  for (int frame = 0; frame < 60; ++frame) {
    values[0] = 1e-3f * std::sin(0.6f * static_cast<float>(frame));
    detector.advance(values);
  }
  EXPECT_TRUE(detector.walking());
}

TEST(StandingDetector, a_model_without_history_cannot_tell_and_walks) {
  testing::RandomModelPlan plan;
  plan.lags = {};
  StandingDetector detector(testing::random_model(plan));
  const std::vector<float> values(5, 0.0f);
  for (int frame = 0; frame < 100; ++frame) EXPECT_TRUE(detector.advance(values));
}

}  // namespace
}  // namespace gait
