// Joints that go missing while a reconstructor runs, and come back.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "gait/play/stream_reconstructor.h"
#include "play/few_walks.h"
#include "play/played_stream.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::frame_of;
using testing::held_out_inputs;
using testing::largest_difference;

// Lets the worker run while there are tables to make.
void pause(const StreamReconstructor& reconstructor) {
  if (!reconstructor.settled()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

TEST(MissingInputs, joints_go_missing_in_mid_walk_and_come_back) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf one_walk = held_out_inputs();
  Eigen::MatrixXf inputs(one_walk.rows(), 3 * one_walk.cols());
  inputs << one_walk, one_walk, one_walk;
  const int lost = 60, back = 110;
  for (const DecoderKind kind : {DecoderKind::viterbi, DecoderKind::forward}) {
    PlaySettings settings;
    settings.decoder = kind;
    StreamReconstructor whole(model, settings), losing(model, settings);
    int disagreements = 0, later_disagreements = 0;
    float largest_later = 0;
    for (int frame = 0; frame < inputs.cols(); ++frame) {
      Eigen::VectorXf given = inputs.col(frame);
      if (frame == lost || frame == back)
        for (int stream = 0; stream < 3; ++stream) losing.set_missing(stream, frame == lost);
      // What a lost sensor sends is not looked at.
      if (frame >= lost && frame < back)
        given.head(9).setConstant(std::numeric_limits<float>::quiet_NaN());
      whole.advance(frame_of(inputs, frame));
      ASSERT_TRUE(losing.advance({given.data(), static_cast<std::size_t>(given.size())}));
      pause(losing);
      for (const float value : losing.frame().outputs) ASSERT_TRUE(std::isfinite(value));
      for (const float value : losing.frame().styles) ASSERT_TRUE(std::isfinite(value));
      const bool disagree =
          whole.recogniser().decision().label != losing.recogniser().decision().label;
      if (frame < lost) {
        EXPECT_FALSE(disagree);
        EXPECT_TRUE(std::ranges::equal(whole.frame().outputs, losing.frame().outputs));
      } else if (frame < back + 15) {
        disagreements += disagree;
      } else if (frame > back + 80) {  // tables, history, paths and queue are whole again
        later_disagreements +=
            disagree || whole.recogniser().decision().state != losing.recogniser().decision().state;
        for (std::size_t i = 0; i < whole.frame().outputs.size(); ++i)
          largest_later = std::max(largest_later,
                                   std::abs(whole.frame().outputs[i] - losing.frame().outputs[i]));
      }
    }
    EXPECT_LT(disagreements, 0.25 * (back + 15 - lost)) << "the rest knows the step too";
    EXPECT_EQ(later_disagreements, 0);
    EXPECT_LT(largest_later, 1e-3f);
  }
}

TEST(MissingInputs, what_a_lost_joint_sends_changes_nothing) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  StreamReconstructor a(model), b(model);
  // Missing from the first frame on, so that both have the same tables for the same frames.
  for (int stream = 0; stream < 2; ++stream)
    a.set_missing(stream, true), b.set_missing(stream, true);
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0, 10);
  EXPECT_TRUE(a.settled());
  a.advance(frame_of(inputs, 0)), b.advance(frame_of(inputs, 0));
  EXPECT_FALSE(a.settled()) << "tables without them are not made within a frame";
  for (int frame = 1; frame < inputs.cols(); ++frame) {
    Eigen::VectorXf given = inputs.col(frame);
    for (int value = 0; value < 6; ++value) given[value] = noise(random);
    a.advance(frame_of(inputs, frame));
    b.advance({given.data(), static_cast<std::size_t>(given.size())});
    // The worker of one may be quicker than the other's by a frame or two.
    pause(a), pause(b);
    if (frame < 80) continue;
    EXPECT_TRUE(a.settled());
    EXPECT_EQ(a.recogniser().decision().state, b.recogniser().decision().state);
    EXPECT_LT(largest_difference(a.frame().outputs, b.frame().outputs), 1e-4f);
  }
}

TEST(MissingInputs, loses_everything_and_lives) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  StreamReconstructor reconstructor(model);
  for (int frame = 0; frame < inputs.cols(); ++frame) {
    if (frame == 30 || frame == 60)
      for (std::size_t stream = 0; stream < model->inputs.size(); ++stream)
        reconstructor.set_missing(static_cast<int>(stream), frame == 30);
    reconstructor.advance(frame_of(inputs, frame));
    pause(reconstructor);
    for (const float value : reconstructor.frame().outputs) ASSERT_TRUE(std::isfinite(value));
  }
}

TEST(MissingInputs, a_frame_that_is_no_measurement_does_not_stay) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  for (const DecoderKind kind : {DecoderKind::viterbi, DecoderKind::forward, DecoderKind::lag}) {
    PlaySettings settings;
    settings.decoder = kind;
    StreamReconstructor reconstructor(model, settings), undisturbed(model, settings);
    for (int frame = 0; frame < inputs.cols(); ++frame) {
      Eigen::VectorXf given = inputs.col(frame);
      if (frame == 50) given[0] = std::numeric_limits<float>::quiet_NaN();
      if (frame == 51) given[4] = std::numeric_limits<float>::infinity();
      if (frame == 52) given[7] = 1e30f;
      if (frame == 53) given.setConstant(-std::numeric_limits<float>::max());
      const bool made =
          reconstructor.advance({given.data(), static_cast<std::size_t>(given.size())});
      undisturbed.advance(frame_of(inputs, frame));
      if (!made) continue;
      for (const float value : reconstructor.frame().outputs)
        ASSERT_TRUE(std::isfinite(value)) << frame;
      if (frame < 90) continue;
      EXPECT_EQ(reconstructor.recogniser().decision().state,
                undisturbed.recogniser().decision().state);
      EXPECT_LT(largest_difference(reconstructor.frame().outputs, undisturbed.frame().outputs),
                1e-3f);
    }
  }
}

}  // namespace
}  // namespace gait
