#include "gait/learn/observed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gait/error.h"

namespace gait {
namespace {

// Three inputs of which the second never moves, two outputs of which the first never does.
Sequence take(unsigned seed, int frames, std::vector<Segment> segments) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto noise = [&] { return normal(random); };
  Sequence sequence;
  sequence.name = "take " + std::to_string(seed);
  sequence.inputs = Eigen::MatrixXd::NullaryExpr(3, frames, noise);
  sequence.inputs.row(1).setConstant(0.7);
  sequence.outputs = Eigen::MatrixXd::NullaryExpr(2, frames, noise);
  sequence.outputs.row(0).setConstant(-0.2);
  sequence.segments = std::move(segments);
  sequence.style = static_cast<int>(seed) % 3;
  return sequence;
}

const std::vector<Sequence>& takes() {
  static const std::vector<Sequence> all{
      take(1, 60, {{10, 20, 0}, {20, 34, 1}, {34, 50, 0}}),
      take(2, 20, {{1, 9, 0}}),  // ends before its history is real
      take(3, 40, {{2, 12, 1}, {12, 25, 0}, {25, 40, 1}})};
  return all;
}

TEST(Observe, inputs_are_what_a_player_will_see_to_the_bit) {
  const ObservationSet set = observe(takes(), {1, 4, 9});
  for (const ObservedSequence& observed : set.sequences) {
    const Sequence& source = takes()[observed.source];
    InputObserver<double> observer(set.input, set.input_scaling);
    for (int frame = 0; frame < source.inputs.cols(); ++frame) {
      observer.advance({source.inputs.col(frame).data(), 3});
      const Eigen::VectorXd learnt = observed.x.col(frame);
      EXPECT_EQ(learnt, observer.scaled()) << observed.name << " frame " << frame;
    }
  }
}

TEST(Observe, inputs_are_the_moving_values_and_their_differences) {
  const std::vector<int> lags{1, 4, 9};
  const ObservationSet set = observe(takes(), lags);
  EXPECT_EQ(set.input.modelled, (std::vector<int>{0, 2}));
  EXPECT_EQ(set.input.values, 3);
  for (const ObservedSequence& observed : set.sequences) {
    const Eigen::MatrixXd& inputs = takes()[observed.source].inputs;
    for (int frame = 9; frame < inputs.cols(); ++frame)
      for (int i = 0; i < 2; ++i) {
        const int value = set.input.modelled[i];
        for (int part = 0; part < 4; ++part) {
          const int entry = part * 2 + i;
          const double raw = part == 0
                                 ? inputs(value, frame)
                                 : inputs(value, frame) - inputs(value, frame - lags[part - 1]);
          EXPECT_EQ(observed.x(entry, frame), (raw - set.input_scaling.mean[entry]) *
                                                  (1 / set.input_scaling.deviation[entry]));
        }
      }
  }
}

TEST(Observe, outputs_have_centred_differences) {
  const ObservationSet set = observe(takes(), {1});
  ASSERT_EQ(set.output.modelled, (std::vector<int>{1}));
  for (const ObservedSequence& observed : set.sequences) {
    const Eigen::MatrixXd& outputs = takes()[observed.source].outputs;
    for (int frame = 1; frame + 1 < outputs.cols(); ++frame) {
      const double before = outputs(1, frame - 1), now = outputs(1, frame),
                   after = outputs(1, frame + 1);
      const double raw[] = {now, (after - before) / 2, before - 2 * now + after};
      for (int part = 0; part < 3; ++part)
        EXPECT_NEAR(
            observed.y(part, frame),
            (raw[part] - set.output_scaling.mean[part]) / set.output_scaling.deviation[part],
            1e-12);
    }
  }
  EXPECT_NEAR(set.output_mean[0], -0.2, 1e-12) << "what never moves is copied from here";
}

TEST(Observe, scales_what_is_used_to_mean_zero_and_deviation_one) {
  const ObservationSet set = observe(takes(), {1, 4});
  for (const bool inputs : {true, false}) {
    const auto of = [&](const ObservedSequence& s) -> const Eigen::MatrixXd& {
      return inputs ? s.x : s.y;
    };
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(of(set.sequences[0]).rows()), squares = sum;
    double count = 0;
    for (const ObservedSequence& observed : set.sequences) {
      const int begin = observed.segments.front().begin, end = observed.segments.back().end;
      const auto used = of(observed).middleCols(begin, end - begin);
      sum += used.rowwise().sum();
      squares += used.rowwise().squaredNorm();
      count += end - begin;
    }
    EXPECT_LT((sum / count).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT(((squares / count).array() - 1).abs().maxCoeff(), 1e-12);
  }
}

TEST(Observe, leaves_out_segments_whose_observation_is_not_whole) {
  const ObservationSet set = observe(takes(), {1, 9});
  ASSERT_EQ(set.sequences.size(), 2u) << "the second has no segment with its history";
  EXPECT_EQ(set.sequences[0].source, 0);
  EXPECT_EQ(set.sequences[1].source, 2);
  EXPECT_EQ(set.sequences[1].name, takes()[2].name);
  EXPECT_EQ(set.sequences[1].style, takes()[2].style);
  ASSERT_EQ(set.sequences[0].segments.size(), 3u);
  // The first begins before frame 9, the last reaches the last frame, which has no neighbour.
  ASSERT_EQ(set.sequences[1].segments.size(), 1u);
  EXPECT_EQ(set.sequences[1].segments[0].begin, 12);
}

TEST(Observe, with_nothing_to_see_is_an_error) {
  EXPECT_THROW(observe({}, {1}), Error);
  EXPECT_THROW(observe({take(1, 30, {})}, {1}), Error);
  EXPECT_THROW(observe({take(1, 30, {{2, 20, 0}})}, {25}), Error);
  Sequence still = take(1, 30, {{5, 20, 0}});
  still.inputs.setConstant(0.1);
  EXPECT_THROW(observe({still}, {1}), Error);
}

}  // namespace
}  // namespace gait
