// Joints that go missing while a player runs, and come back.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "gait/play/player.h"
#include "play/few_walks.h"
#include "play/played_stream.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::frame_of;
using testing::held_out_inputs;
using testing::largest_difference;

// Lets the worker run while there are tables to make.
void pause(const Player& player) {
  if (!player.settled()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

TEST(MissingInputs, joints_go_missing_in_mid_walk_and_come_back) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf one_walk = held_out_inputs();
  Eigen::MatrixXf inputs(one_walk.rows(), 3 * one_walk.cols());
  inputs << one_walk, one_walk, one_walk;
  const int lost = 60, back = 110;
  for (const DecoderKind kind : {DecoderKind::viterbi, DecoderKind::forward}) {
    PlayerSettings settings;
    settings.decoder = kind;
    Player whole(model, settings), losing(model, settings);
    int disagreements = 0, later_disagreements = 0;
    float largest_later = 0;
    for (int frame = 0; frame < inputs.cols(); ++frame) {
      Eigen::VectorXf given = inputs.col(frame);
      if (frame == lost || frame == back)
        for (int value = 0; value < 9; ++value) losing.set_missing(value, frame == lost);
      // What a lost sensor sends is not looked at.
      if (frame >= lost && frame < back)
        given.head(9).setConstant(std::numeric_limits<float>::quiet_NaN());
      whole.advance(frame_of(inputs, frame));
      losing.advance({given.data(), static_cast<std::size_t>(given.size())});
      pause(losing);
      ASSERT_EQ(losing.available(), 1);
      for (const float value : losing.output(0)) ASSERT_TRUE(std::isfinite(value));
      for (const float value : losing.styles(0)) ASSERT_TRUE(std::isfinite(value));
      const bool disagree = whole.latest().label != losing.latest().label;
      if (frame < lost) {
        EXPECT_FALSE(disagree);
        EXPECT_TRUE(std::ranges::equal(whole.output(0), losing.output(0)));
      } else if (frame < back + 15) {
        disagreements += disagree;
      } else if (frame > back + 80) {  // tables, history, paths and queue are whole again
        later_disagreements += disagree || whole.latest().state != losing.latest().state;
        for (std::size_t i = 0; i < whole.output(0).size(); ++i)
          largest_later =
              std::max(largest_later, std::abs(whole.output(0)[i] - losing.output(0)[i]));
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
  Player a(model), b(model);
  // Missing from the first frame on, so that both have the same tables for the same frames.
  for (int value = 0; value < 6; ++value) a.set_missing(value, true), b.set_missing(value, true);
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
    EXPECT_EQ(a.latest().state, b.latest().state);
    EXPECT_LT(largest_difference(a.output(0), b.output(0)), 1e-4f);
  }
}

TEST(MissingInputs, loses_everything_and_lives) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  Player player(model);
  const int values = model->input.values;
  for (int frame = 0; frame < inputs.cols(); ++frame) {
    if (frame == 30 || frame == 60)
      for (int value = 0; value < values; ++value) player.set_missing(value, frame == 30);
    player.advance(frame_of(inputs, frame));
    pause(player);
    for (const float value : player.output(0)) ASSERT_TRUE(std::isfinite(value));
  }
}

TEST(MissingInputs, a_frame_that_is_no_measurement_does_not_stay) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  for (const DecoderKind kind : {DecoderKind::viterbi, DecoderKind::forward, DecoderKind::lag}) {
    PlayerSettings settings;
    settings.decoder = kind;
    Player player(model, settings), undisturbed(model, settings);
    for (int frame = 0; frame < inputs.cols(); ++frame) {
      Eigen::VectorXf given = inputs.col(frame);
      if (frame == 50) given[0] = std::numeric_limits<float>::quiet_NaN();
      if (frame == 51) given[4] = std::numeric_limits<float>::infinity();
      if (frame == 52) given[7] = 1e30f;
      if (frame == 53) given.setConstant(-std::numeric_limits<float>::max());
      player.advance({given.data(), static_cast<std::size_t>(given.size())});
      undisturbed.advance(frame_of(inputs, frame));
      if (player.available() == 0) continue;
      for (const float value : player.output(0)) ASSERT_TRUE(std::isfinite(value)) << frame;
      if (frame < 90) continue;
      EXPECT_EQ(player.latest().state, undisturbed.latest().state);
      EXPECT_LT(largest_difference(player.output(0), undisturbed.output(0)), 1e-3f);
    }
  }
}

}  // namespace
}  // namespace gait
