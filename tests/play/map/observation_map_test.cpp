#include "gait/play/map/observation_map.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "gait/play/map/observation_message.h"
#include "gait/play/stream_reconstructor.h"
#include "play/few_walks.h"
#include "play/forbidden_memory.h"
#include "play/played_stream.h"
#include "play/random_model.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::ForbiddenMemory;
using testing::frame_of;
using testing::held_out_inputs;

// The modelled entries of a map's Gaussian, as the trajectory takes them.
OutputGaussian modelled_of(const ObservationMap& map, const Model& model) {
  const int statics = model.output.statics(), values = model.output.values;
  OutputGaussian gaussian{Eigen::VectorXf(3 * statics), Eigen::VectorXf(3 * statics)};
  for (int part = 0; part < 3; ++part)
    for (int i = 0; i < statics; ++i) {
      const int value = part * values + model.output.modelled[i];
      gaussian.mean[part * statics + i] = map.mean()[value];
      gaussian.variance[part * statics + i] = map.variance()[value];
    }
  return gaussian;
}

void map_from(ObservationMap& map, const ObservationMessage& message) {
  map.map(message.states(), message.missing(), message.observation());
}

TEST(ObservationMap, what_a_recogniser_sends_it_becomes_what_a_reconstructor_plays) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs("in-a-hurry");
  for (const DecoderKind kind : {DecoderKind::viterbi, DecoderKind::forward, DecoderKind::lag}) {
    PlaySettings settings;
    settings.decoder = kind;
    settings.past = 20;
    settings.future = 0;
    StreamReconstructor reconstructor(model, settings);
    Recogniser recogniser(model, settings);
    ObservationMessage sent(*model), received(*model);
    ObservationMap map(model);
    Trajectory trajectory(model->output.statics(), 20, 1, 0);
    int compared = 0;
    for (int frame = 0; frame < inputs.cols(); ++frame) {
      const bool made = reconstructor.advance(frame_of(inputs, frame));
      if (!recogniser.advance(frame_of(inputs, frame))) continue;
      ASSERT_EQ(received.read(sent.write(recogniser)), nullptr);
      EXPECT_EQ(received.lag(), recogniser.lag());
      map_from(map, received);
      EXPECT_FLOAT_EQ(map.distance(), recogniser.decision().distance);
      OutputGaussian eased = modelled_of(map, *model);
      eased.variance.tail(2 * model->output.statics()) *= static_cast<float>(model->play.easing);
      trajectory.push(eased);
      const Eigen::MatrixXf statics = trajectory.generate();
      ASSERT_TRUE(made);
      for (int i = 0; i < model->output.statics(); ++i)
        EXPECT_NEAR(statics(i, 0), reconstructor.frame().outputs[model->output.modelled[i]], 1e-6)
            << "frame " << frame;
      ++compared;
    }
    EXPECT_GT(compared, 100);
  }
}

TEST(ObservationMap, follows_a_recogniser_that_loses_inputs) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs("drunk");
  Recogniser recogniser(model);
  ObservationMessage message(*model);
  ObservationMap map(model);
  for (int value = 0; value < 6; ++value) recogniser.set_missing(value, true);
  int compared = 0;
  for (int frame = 0; frame < inputs.cols(); ++frame) {
    recogniser.advance(frame_of(inputs, frame));
    ASSERT_EQ(message.read(message.write(recogniser)), nullptr);
    map_from(map, message);
    if (!recogniser.settled() || !map.settled())
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (recogniser.missing().empty() || !map.settled()) continue;
    // By the same tables, made by another.
    CovarianceMap direct(*model, recogniser.tables());
    const OutputGaussian& expected =
        direct.map(recogniser.states(), recogniser.unclipped(), recogniser.known());
    map_from(map, message);
    const OutputGaussian found = modelled_of(map, *model);
    EXPECT_LT((found.mean - expected.mean).cwiseAbs().maxCoeff(), 1e-6f);
    EXPECT_LT((found.variance - expected.variance).cwiseAbs().maxCoeff(), 1e-6f);
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

// A model whose output has a value that never moves, in the second of two streams.
Model two_outputs() {
  testing::RandomModelPlan plan;
  plan.outputs = 4;
  Model model = testing::random_model(plan);
  model.outputs = {{"a", 2, StreamKind::plain}, {"b", 3, StreamKind::plain}};
  model.output.values = 5;
  model.output.modelled = {0, 1, 3, 4};
  model.output_mean.resize(5);
  model.output_mean << 0.1, 0.2, 7, 0.4, 0.5;
  return model;
}

TEST(ObservationMap, strength_bias_and_spread_change_what_they_are_told_to) {
  const auto model = std::make_shared<const Model>(two_outputs());
  const Eigen::VectorXf x = testing::random_vector(model->input.size(), 3);
  const std::span<const float> observation{x.data(), static_cast<std::size_t>(x.size())};
  const WeightedState states[] = {{1, 0.75f}, {3, 0.25f}};
  ObservationMap plain(model), changed(model);
  plain.map(states, {}, observation);
  EXPECT_EQ(plain.mean()[2], 7) << "what never moves is as it was";
  EXPECT_EQ(plain.mean()[5 + 2], 0);
  EXPECT_EQ(plain.variance()[2], 0);
  const std::vector<float> mean(plain.mean().begin(), plain.mean().end());
  const std::vector<float> variance(plain.variance().begin(), plain.variance().end());

  EXPECT_TRUE(changed.set_strength(1, 0.0f));
  changed.map(states, {}, observation);
  for (const int value : {0, 1}) EXPECT_EQ(changed.mean()[value], mean[value]);
  for (const int value : {3, 4}) {
    double average = 0;  // the average walk: the states' means alone
    for (const WeightedState& state : states) {
      const int entry = model->input.size() + value - 1;
      average += state.weight * (model->output_scaling.mean[value - 1] +
                                 model->output_scaling.deviation[value - 1] *
                                     testing::state_of(*model, state.state).mean[entry]);
    }
    EXPECT_NEAR(changed.mean()[value], average, 1e-5);
  }
  EXPECT_TRUE(changed.set_strength(1.0f));
  const std::vector<float> bias{0.5f, -1, 2};
  EXPECT_TRUE(changed.set_bias(1, bias));
  EXPECT_TRUE(changed.set_spread(4));
  changed.map(states, {}, observation);
  for (int value = 0; value < 15; ++value) {
    const float moved = value >= 2 && value < 5 ? bias[value - 2] : 0;
    EXPECT_FLOAT_EQ(changed.mean()[value], mean[value] + moved);
    EXPECT_FLOAT_EQ(changed.variance()[value], 4 * variance[value]);
  }
}

TEST(ObservationMap, settings_out_of_range_change_nothing) {
  const auto model = std::make_shared<const Model>(two_outputs());
  ObservationMap map(model);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(map.set_strength(nan));
  EXPECT_FALSE(map.set_strength(11.0f));
  EXPECT_FALSE(map.set_strength(2, 1));
  EXPECT_FALSE(map.set_strength(-1, 1));
  EXPECT_FALSE(map.set_bias(0, std::vector<float>{1, 2, 3}));
  EXPECT_FALSE(map.set_bias(0, std::vector<float>{1, nan}));
  EXPECT_FALSE(map.set_spread(0));
  EXPECT_EQ(map.strength(0), 1);
  EXPECT_EQ(map.bias(0)[1], 0);
  EXPECT_EQ(map.spread(), 1);
}

TEST(ObservationMessage, refuses_rows_that_are_not_of_the_model) {
  const Model model = testing::random_model();  // 5 inputs, lags 1 and 3: 15 entries; 5 states
  ObservationMessage message(model);
  std::vector<float> row{2, 2, 1, 0.5f, 4, 0.5f, 1, 3, 10};
  for (int i = 0; i < 10; ++i) row.push_back(static_cast<float>(i));
  ASSERT_EQ(message.read(row), nullptr);
  EXPECT_EQ(message.lag(), 2);
  EXPECT_EQ(message.states()[1].state, 4);
  EXPECT_EQ(message.missing()[0], 3);
  EXPECT_EQ(message.observation().size(), 10u);
  const auto refused = [&](auto change) {
    std::vector<float> wrong = row;
    change(wrong);
    EXPECT_NE(message.read(wrong), nullptr);
    EXPECT_EQ(message.lag(), 2);
    EXPECT_EQ(message.states().size(), 2u);
    EXPECT_EQ(message.observation()[9], 9);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [at, value] : std::vector<std::pair<int, float>>{{0, -1},
                                                                    {0, 0.5f},
                                                                    {0, nan},
                                                                    {1, 0},
                                                                    {1, 9},
                                                                    {1, 1e9f},
                                                                    {2, 5},
                                                                    {2, -1},
                                                                    {3, -0.5f},
                                                                    {3, nan},
                                                                    {6, 7},
                                                                    {7, 5},
                                                                    {8, 0},
                                                                    {8, 9},
                                                                    {8, 20},
                                                                    {12, nan}})
    refused([&, at = at, value = value](std::vector<float>& wrong) { wrong[at] = value; });
  refused([](std::vector<float>& wrong) { wrong.pop_back(); });
  refused([](std::vector<float>& wrong) { wrong.push_back(0); });
  refused([](std::vector<float>& wrong) { wrong[3] = wrong[5] = 0; });
  refused([](std::vector<float>& wrong) { wrong.clear(); });
  for (std::size_t length = 0; length < row.size(); ++length)
    refused([&](std::vector<float>& wrong) { wrong.resize(length); });
}

TEST(ObservationMap, takes_no_memory_while_it_maps) {
  if (!ForbiddenMemory::works()) GTEST_SKIP() << "a sanitizer has malloc";
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs("drunk");
  Recogniser recogniser(model);
  ObservationMessage message(*model);
  ObservationMap map(model);
  long allocations = 0, releases = 0;
  {
    const ForbiddenMemory forbidden;
    for (int frame = 0; frame < 100; ++frame) {
      if (frame == 30 || frame == 60)
        for (int value = 0; value < 3; ++value) recogniser.set_missing(value, frame == 30);
      recogniser.advance(frame_of(inputs, frame));
      message.read(message.write(recogniser));
      map_from(map, message);
      map.set_strength(0, 1.2f);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    allocations = forbidden.allocations();
    releases = forbidden.releases();
  }
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(releases, 0);
}

}  // namespace
}  // namespace gait
