#include "gait/play/stream_reconstructor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "play/few_walks.h"
#include "play/played_stream.h"
#include "play/random_model.h"

namespace gait {
namespace {

using testing::few_walks_model;
using testing::frame_of;
using testing::held_out_inputs;
using testing::largest_difference;
using testing::plan_of;
using testing::play_through;
using testing::Played;
using testing::streams_of;

TEST(StreamReconstructor, knows_the_steps_and_style_of_a_walk_it_has_not_seen) {
  const auto model = few_walks_model();
  const CorpusWalk walk = make_walk(plan_of("in-a-hurry", 9));
  const Sequence truth = streams_of(walk, *model->body);
  StreamReconstructor reconstructor(model);
  const Played played = play_through(reconstructor, truth.inputs.cast<float>());
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

TEST(StreamReconstructor, hands_out_every_frame_once_whatever_the_delays) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  const int frames = static_cast<int>(inputs.cols());
  for (const double lag : {0.0, 0.1})
    for (const int current : {1, 3})
      for (const int future : {0, 4}) {
        PlaySettings settings;
        settings.decoder = DecoderKind::lag;
        settings.lag = lag;
        settings.past = 10;
        settings.current = current;
        settings.future = future;
        StreamReconstructor reconstructor(model, settings);
        EXPECT_EQ(reconstructor.delay(), std::lround(lag * 30) + future + current - 1);
        int out = 0;
        for (int frame = 0; frame < frames; ++frame) {
          out += reconstructor.advance(frame_of(inputs, frame));
          EXPECT_GE(out, frame + 1 - reconstructor.delay());
          EXPECT_LE(out, std::max(0, frame + 1 - static_cast<int>(std::lround(lag * 30)) - future));
        }
        while (reconstructor.flush()) ++out;
        EXPECT_EQ(out, frames) << "lag " << lag << " C " << current << " F " << future;
        EXPECT_FALSE(reconstructor.flush());
      }
}

TEST(StreamReconstructor, with_delay_speaks_of_the_frame_that_it_hands_out) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs();
  PlaySettings now, later;
  now.decoder = later.decoder = DecoderKind::viterbi;
  now.past = later.past = 0;
  now.future = 0;
  later.future = 5;
  StreamReconstructor prompt(model, now), late(model, later);
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

TEST(StreamReconstructor, a_lag_of_the_whole_walk_decides_as_a_look_back_from_its_end) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf inputs = held_out_inputs("drunk");
  PlaySettings settings;
  settings.decoder = DecoderKind::lag;
  settings.lag = static_cast<double>(inputs.cols()) / 30;
  StreamReconstructor reconstructor(model, settings);
  const Played whole = play_through(reconstructor, inputs);
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

TEST(StreamReconstructor, sets_values_that_never_move_to_what_they_were) {
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
  StreamReconstructor reconstructor(std::make_shared<const Model>(model)), whole(few_walks_model());
  const Eigen::MatrixXf inputs = held_out_inputs();
  const Played played = play_through(reconstructor, inputs), full = play_through(whole, inputs);
  for (std::size_t frame = 0; frame < played.outputs.size(); ++frame) {
    EXPECT_EQ(played.outputs[frame][value], 0.625f);
    for (const int other : model.output.modelled)
      EXPECT_NEAR(played.outputs[frame][other], full.outputs[frame][other], 1e-4);
  }
}

TEST(StreamReconstructor, after_a_reset_plays_as_a_new_one) {
  const auto model = few_walks_model();
  const Eigen::MatrixXf first = held_out_inputs("drunk"), second = held_out_inputs("sad");
  StreamReconstructor used(model), fresh(model);
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

TEST(StreamReconstructor, plays_streams_that_are_no_body_and_labels_that_are_no_steps) {
  const auto model = std::make_shared<const Model>(testing::random_model({.states = {2, 3, 1}}));
  StreamReconstructor reconstructor(model);
  for (unsigned frame = 0; frame < 50; ++frame) {
    const Eigen::VectorXf values = testing::random_vector(model->input.values, frame);
    ASSERT_TRUE(reconstructor.advance({values.data(), static_cast<std::size_t>(values.size())}));
    const Decision& decision = reconstructor.frame().decision;
    EXPECT_GE(decision.label, 0);
    EXPECT_LT(decision.label, 3);
    EXPECT_GE(decision.phase, 0);
    EXPECT_LE(decision.phase, 1);
    for (const float value : reconstructor.frame().outputs) EXPECT_TRUE(std::isfinite(value));
    EXPECT_TRUE(reconstructor.frame().pose.empty());
  }
}

}  // namespace
}  // namespace gait
