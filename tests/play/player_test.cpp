#include "gait/play/player.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "play/few_walks.h"
#include "play/random_model.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::plan_of;
using testing::streams_of;

struct Played {
  std::vector<std::vector<float>> outputs;
  std::vector<Decision> decisions;
  std::vector<std::vector<float>> styles;

  void collect(const Player& player) {
    for (int i = 0; i < player.available(); ++i) {
      outputs.emplace_back(player.output(i).begin(), player.output(i).end());
      decisions.push_back(player.decision(i));
      styles.emplace_back(player.styles(i).begin(), player.styles(i).end());
    }
  }
};

std::span<const float> frame_of(const Eigen::MatrixXf& inputs, int frame) {
  return {inputs.col(frame).data(), static_cast<std::size_t>(inputs.rows())};
}

Played play_through(Player& player, const Eigen::MatrixXf& inputs) {
  Played played;
  for (int frame = 0; frame < inputs.cols(); ++frame) {
    player.advance(frame_of(inputs, frame));
    played.collect(player);
  }
  while (player.flush()) played.collect(player);
  return played;
}

Eigen::MatrixXf held_out_inputs(const char* style = "sad") {
  const CorpusWalk walk = make_walk(plan_of(style, 9));
  return streams_of(walk, *few_walks_model()->body).inputs.cast<float>();
}

float largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

TEST(Player, knows_the_steps_and_style_of_a_walk_it_has_not_seen) {
  const auto model = few_walks_model();
  const CorpusWalk walk = make_walk(plan_of("in-a-hurry", 9));
  const Sequence truth = streams_of(walk, *model->body);
  Player player(model);
  const Played played = play_through(player, truth.inputs.cast<float>());
  ASSERT_EQ(static_cast<int>(played.decisions.size()), walk.clip.frames());
  int right = 0, frames = 0;
  double distance = 0;
  for (const Segment& segment : truth.segments)
    for (int frame = segment.begin; frame < segment.end; ++frame, ++frames) {
      right += played.decisions[frame].label == segment.label;
      distance += played.decisions[frame].distance;
    }
  EXPECT_GT(right, 0.9 * frames);
  EXPECT_LT(distance / frames, 3) << "it is much like what was taught";
  EXPECT_GT(distance / frames, 0.2);
  const Decision& last = played.decisions.back();
  const double seconds = (walk.contacts.back().frame - walk.contacts.front().frame) / 30.0;
  EXPECT_NEAR(last.cadence, static_cast<double>(walk.contacts.size() - 1) / seconds, 0.3);
  const auto& styles = played.styles.back();
  const auto best = std::max_element(styles.begin(), styles.end()) - styles.begin();
  EXPECT_EQ(model->styles[best], "in-a-hurry");
}

TEST(Player, hands_out_every_frame_once_whatever_the_delays) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  const int frames = static_cast<int>(inputs.cols());
  for (const double lag : {0.0, 0.1})
    for (const int current : {1, 3})
      for (const int future : {0, 4}) {
        PlayerSettings settings;
        settings.decoder = DecoderKind::lag;
        settings.lag = lag;
        settings.past = 10;
        settings.current = current;
        settings.future = future;
        Player player(model, settings);
        EXPECT_EQ(player.delay(), std::lround(lag * 30) + future + current - 1);
        int out = 0;
        for (int frame = 0; frame < frames; ++frame) {
          player.advance(frame_of(inputs, frame));
          out += player.available();
          EXPECT_GE(out, frame + 1 - player.delay());
          EXPECT_LE(out, std::max(0, frame + 1 - static_cast<int>(std::lround(lag * 30)) - future));
        }
        while (player.flush()) out += player.available();
        EXPECT_EQ(out, frames) << "lag " << lag << " C " << current << " F " << future;
        EXPECT_FALSE(player.flush());
      }
}

TEST(Player, with_delay_speaks_of_the_frame_that_it_hands_out) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  PlayerSettings now, later;
  now.decoder = later.decoder = DecoderKind::viterbi;
  now.past = later.past = 0;
  now.future = 0;
  later.future = 5;
  Player prompt(model, now), late(model, later);
  const Played a = play_through(prompt, inputs), b = play_through(late, inputs);
  ASSERT_EQ(a.decisions.size(), b.decisions.size());
  for (std::size_t i = 0; i < a.decisions.size(); ++i) {
    EXPECT_EQ(a.decisions[i].state, b.decisions[i].state) << "frame " << i;
    EXPECT_EQ(a.decisions[i].log_likelihood, b.decisions[i].log_likelihood);
    EXPECT_EQ(a.styles[i], b.styles[i]);
    // Smoothed by what comes after, but of the same moment.
    EXPECT_LT(largest_difference(a.outputs[i], b.outputs[i]), 0.5f);
  }
}

TEST(Player, a_lag_of_the_whole_walk_decides_as_a_look_back_from_its_end) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs("drunk");
  PlayerSettings settings;
  settings.decoder = DecoderKind::lag;
  settings.lag = static_cast<double>(inputs.cols()) / 30;
  Player player(model, settings);
  const Played whole = play_through(player, inputs);
  ASSERT_EQ(static_cast<Eigen::Index>(whole.decisions.size()), inputs.cols());
  // On the best path states follow each other in order, without skips.
  for (std::size_t i = 1; i < whole.decisions.size(); ++i) {
    const Decision &a = whole.decisions[i - 1], &b = whole.decisions[i];
    const int states = static_cast<int>(model->labels[a.label].states.size());
    const bool stays = a.label == b.label && a.state == b.state;
    const bool moves = a.label == b.label && b.state == a.state + 1;
    const bool next = a.label != b.label && a.state == states - 1 && b.state == 0;
    EXPECT_TRUE(stays || moves || next) << "frame " << i;
  }
}

TEST(Player, sets_values_that_never_move_to_what_they_were) {
  Model model = *few_walks_model();
  // The second output value is one that never moved in training.
  const int statics = model.output.statics(), removed = 1;
  const auto keep = [&](Eigen::Index size, int offset) {
    std::vector<int> kept;
    for (int i = 0; i < size; ++i)
      if (i < offset || (i - offset) % statics != removed) kept.push_back(i);
    return kept;
  };
  const int x = model.input.size();
  const auto z = keep(x + 3 * statics, x), y = keep(3 * statics, 0);
  for (Label& label : model.labels)
    for (State& state : label.states) {
      state.mean = Eigen::VectorXd(state.mean(z));
      state.covariance = Eigen::MatrixXd(state.covariance(z, z));
      state.style_means = Eigen::MatrixXd(state.style_means(z, Eigen::all));
    }
  model.output_scaling.mean = Eigen::VectorXd(model.output_scaling.mean(y));
  model.output_scaling.deviation = Eigen::VectorXd(model.output_scaling.deviation(y));
  const int value = model.output.modelled[removed];
  model.output.modelled.erase(model.output.modelled.begin() + removed);
  model.output_mean[value] = 0.625;
  Player player(std::make_shared<const Model>(model)), whole(few_walks_model());
  const Eigen::MatrixXf inputs = held_out_inputs();
  const Played played = play_through(player, inputs), full = play_through(whole, inputs);
  for (std::size_t frame = 0; frame < played.outputs.size(); ++frame) {
    EXPECT_EQ(played.outputs[frame][value], 0.625f);
    for (const int other : model.output.modelled)
      EXPECT_NEAR(played.outputs[frame][other], full.outputs[frame][other], 1e-4);
  }
}

// Lets the worker run while there are tables to make.
void pause(const Player& player) {
  if (!player.settled()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

TEST(Player, joints_go_missing_in_mid_walk_and_come_back) {
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

TEST(Player, what_a_lost_joint_sends_changes_nothing) {
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
    EXPECT_LT(largest_difference({a.output(0).begin(), a.output(0).end()},
                                 {b.output(0).begin(), b.output(0).end()}),
              1e-4f);
  }
}

TEST(Player, loses_everything_and_lives) {
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

TEST(Player, a_frame_that_is_not_a_number_does_not_stay) {
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
      player.advance({given.data(), static_cast<std::size_t>(given.size())});
      undisturbed.advance(frame_of(inputs, frame));
      if (player.available() == 0) continue;
      for (const float value : player.output(0)) ASSERT_TRUE(std::isfinite(value)) << frame;
      if (frame < 90) continue;
      EXPECT_EQ(player.latest().state, undisturbed.latest().state);
      EXPECT_LT(largest_difference({player.output(0).begin(), player.output(0).end()},
                                   {undisturbed.output(0).begin(), undisturbed.output(0).end()}),
                1e-3f);
    }
  }
}

TEST(Player, after_a_reset_plays_as_a_new_one) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf first = held_out_inputs("drunk"), second = held_out_inputs("sad");
  Player used(model), fresh(model);
  play_through(used, first);
  used.reset();
  const Played a = play_through(used, second), b = play_through(fresh, second);
  ASSERT_EQ(a.outputs.size(), b.outputs.size());
  for (std::size_t frame = 0; frame < a.outputs.size(); ++frame) {
    EXPECT_EQ(a.outputs[frame], b.outputs[frame]);
    EXPECT_EQ(a.styles[frame], b.styles[frame]);
    EXPECT_EQ(a.decisions[frame].state, b.decisions[frame].state);
    EXPECT_EQ(a.decisions[frame].phase, b.decisions[frame].phase);
  }
}

TEST(Player, plays_streams_that_are_no_body_and_labels_that_are_no_steps) {
  const auto model = std::make_shared<const Model>(testing::random_model({.states = {2, 3, 1}}));
  Player player(model);
  for (unsigned frame = 0; frame < 50; ++frame) {
    const Eigen::VectorXf values = testing::random_vector(model->input.values, frame);
    player.advance({values.data(), static_cast<std::size_t>(values.size())});
    ASSERT_EQ(player.available(), 1);
    const Decision& decision = player.decision(0);
    EXPECT_GE(decision.label, 0);
    EXPECT_LT(decision.label, 3);
    EXPECT_GE(decision.phase, 0);
    EXPECT_LE(decision.phase, 1);
    for (const float value : player.output(0)) EXPECT_TRUE(std::isfinite(value));
  }
}

}  // namespace
}  // namespace gait
