#include "gait/play/recognise/recogniser.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "gait/play/stream_reconstructor.h"
#include "play/few_walks.h"
#include "play/played_stream.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::frame_of;
using testing::held_out_inputs;

RecogniserSettings decoding(DecoderKind kind, double lag = 0) {
  RecogniserSettings settings;
  settings.decoder = kind;
  settings.lag = lag;
  return settings;
}

TEST(Recogniser, shows_the_observation_that_it_decided_on) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs("drunk");
  const std::vector<int>& lags = model->input.lags;
  const int statics = model->input.statics();
  for (const double lag : {0.0, 0.1}) {
    Recogniser recogniser(model, decoding(DecoderKind::lag, lag));
    EXPECT_EQ(recogniser.lag(), std::lround(lag * 30));
    int decided = 0;
    const auto look = [&] {
      const int frame = decided++;
      EXPECT_EQ(recogniser.known(), model->input.known(frame));
      for (int i = 0; i < recogniser.known(); ++i) {
        const int value = model->input.modelled[i % statics];
        const int back = i < statics ? 0 : lags[i / statics - 1];
        const float expected =
            back == 0 ? inputs(value, frame) : inputs(value, frame) - inputs(value, frame - back);
        EXPECT_EQ(recogniser.observation()[i], expected) << "frame " << frame << " entry " << i;
      }
    };
    for (int frame = 0; frame < inputs.cols(); ++frame)
      if (recogniser.advance(frame_of(inputs, frame))) look();
    EXPECT_EQ(decided, inputs.cols() - recogniser.lag());
    while (recogniser.flush()) look();
    EXPECT_EQ(decided, inputs.cols());
  }
}

TEST(Recogniser, its_weighted_states_lead_to_its_decision) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  for (const DecoderKind kind : {DecoderKind::viterbi, DecoderKind::forward}) {
    Recogniser recogniser(model, decoding(kind));
    for (int frame = 0; frame < inputs.cols(); ++frame) {
      ASSERT_TRUE(recogniser.advance(frame_of(inputs, frame)));
      float total = 0, styles = 0;
      for (const WeightedState& state : recogniser.states()) total += state.weight;
      for (const float posterior : recogniser.styles()) styles += posterior;
      EXPECT_NEAR(total, 1, 1e-5);
      EXPECT_NEAR(styles, 1, 1e-5);
      const int state = recogniser.states().front().state;
      const int label = recogniser.tables()->states[state].label;
      EXPECT_EQ(recogniser.decision().label, label);
      EXPECT_EQ(recogniser.decision().state, state - recogniser.tables()->first_state[label]);
      EXPECT_NEAR(recogniser.late(), recogniser.phase_estimate().age, 1e-6);
    }
  }
}

TEST(Recogniser, says_which_inputs_its_decisions_leave_out) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  Recogniser recogniser(model);
  EXPECT_TRUE(recogniser.missing().empty());
  const std::vector<int> lost{3, 4, 5};
  for (const int value : lost) recogniser.set_missing(value, true);
  recogniser.advance(frame_of(inputs, 0));
  for (int frame = 1; !recogniser.settled() && frame < 100; ++frame) {
    EXPECT_TRUE(recogniser.missing().empty()) << "not before there are tables for that";
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    recogniser.advance(frame_of(inputs, frame));
    if (!recogniser.missing().empty()) break;
  }
  std::vector<int> modelled;
  for (const int value : lost)
    if (std::ranges::count(model->input.modelled, value) > 0) modelled.push_back(value);
  EXPECT_FALSE(modelled.empty());
  EXPECT_TRUE(std::ranges::equal(recogniser.missing(), modelled));
}

TEST(Recogniser, the_phase_of_one_who_does_not_walk_stands) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  Recogniser recogniser(model);
  int frame = 0;
  for (; frame < 60; ++frame) recogniser.advance(frame_of(inputs, frame));
  recogniser.set_walking(false);
  for (; frame < 75; ++frame) recogniser.advance(frame_of(inputs, frame));
  const float stood = recogniser.decision().phase;
  EXPECT_EQ(recogniser.decision().cadence, 0);
  for (; frame < 90; ++frame) recogniser.advance(frame_of(inputs, frame));
  EXPECT_EQ(recogniser.decision().phase, stood);
  recogniser.set_walking(true);
  for (; frame < 100; ++frame) recogniser.advance(frame_of(inputs, frame));
  EXPECT_NE(recogniser.decision().phase, stood);
  EXPECT_GT(recogniser.decision().cadence, 0.5);
}

}  // namespace
}  // namespace gait
