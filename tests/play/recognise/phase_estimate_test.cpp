#include "gait/play/recognise/phase_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace gait {
namespace {

// Labels of four states of 0.1 s each, observed with differences 2 and 4 frames back.
Model model_of(const std::vector<std::vector<int>>& successors) {
  Model model;
  model.frame_rate = 30;
  model.input.lags = {2, 4};
  for (const auto& next : successors) {
    Label label;
    label.successors = next;
    label.states.assign(4, {});
    for (State& state : label.states) state.duration = 0.1;
    model.labels.push_back(label);
  }
  return model;
}

float phase_in(const PhaseEstimator& estimator, int state, float progress) {
  const WeightedState one{state, 1};
  return estimator.of({&one, 1}, progress).phase;
}

TEST(PhaseEstimate, the_right_step_is_the_first_half_of_the_cycle_and_the_left_one_the_second) {
  const PhaseEstimator estimator(model_of({{1}, {0}}));
  EXPECT_FLOAT_EQ(phase_in(estimator, 0, 0), 0);
  EXPECT_FLOAT_EQ(phase_in(estimator, 2, 0.5f), 0.25f);
  EXPECT_FLOAT_EQ(phase_in(estimator, 4, 0), 0.5f);
  EXPECT_FLOAT_EQ(phase_in(estimator, 7, 0.9f), 0.95f);
  EXPECT_EQ(estimator.cycle(0).labels, 2);
  EXPECT_NEAR(estimator.cycle(0).cadence(), 2.5, 1e-5);
}

TEST(PhaseEstimate, labels_in_any_ring_share_its_cycle_and_others_have_their_own) {
  // 0 -> 3 -> 1 -> 0 is a ring, 2 repeats, 4 chooses, 5 leads into the ring without being of it.
  const PhaseEstimator estimator(model_of({{3}, {0}, {2}, {1}, {0, 2}, {0}}));
  EXPECT_FLOAT_EQ(phase_in(estimator, 0 * 4, 0.5f), 0.5f / 3);
  EXPECT_FLOAT_EQ(phase_in(estimator, 3 * 4, 0.5f), 1.5f / 3);
  EXPECT_FLOAT_EQ(phase_in(estimator, 1 * 4, 0.5f), 2.5f / 3);
  for (const int alone : {2, 4, 5}) {
    EXPECT_FLOAT_EQ(phase_in(estimator, alone * 4, 0.25f), 0.25f);
    EXPECT_EQ(estimator.cycle(alone).labels, 1);
    EXPECT_NEAR(estimator.cycle(alone).cadence(), 2.5, 1e-5);
  }
  for (const int together : {0, 1, 3}) {
    EXPECT_EQ(estimator.cycle(together).labels, 3);
    EXPECT_NEAR(estimator.cycle(together).cadence(), 2.5, 1e-5);
  }
}

TEST(PhaseEstimate, is_never_one_even_at_the_very_end_of_a_cycle) {
  const PhaseEstimator estimator(model_of({{1}, {0}}));
  const float phase = phase_in(estimator, 7, 1);
  EXPECT_LT(phase, 1);
  EXPECT_GT(phase, 0.99f);
}

TEST(PhaseEstimate, several_states_speak_by_their_circular_mean_across_the_seam_too) {
  const PhaseEstimator estimator(model_of({{1}, {0}}));
  // The last state of the cycle lies at 15/16, the first at 1/16: between them is 0.
  const WeightedState seam[2] = {{7, 0.5f}, {0, 0.5f}};
  const PhaseEstimate at_seam = estimator.of(seam, 0.9f);
  EXPECT_NEAR(std::remainder(at_seam.phase, 1.0f), 0, 1e-5);
  EXPECT_NEAR(at_seam.certainty, std::cos(2 * M_PI / 16), 1e-5);
  const WeightedState apart[2] = {{0, 0.5f}, {4, 0.5f}};
  EXPECT_NEAR(estimator.of(apart, 0).certainty, 0, 1e-5) << "half a cycle apart: nothing is known";
  const WeightedState leaning[2] = {{2, 0.8f}, {3, 0.2f}};
  const float between = estimator.of(leaning, 0).phase;
  EXPECT_GT(between, 2.5f / 8);
  EXPECT_LT(between, 3.0f / 8);
}

TEST(PhaseEstimate, says_what_was_seen_when_the_observation_was_of_mean_age) {
  // Pose now, and differences whose middles lie one and two frames back: a frame on average. The
  // cycle lasts 0.8 s.
  const PhaseEstimator estimator(model_of({{1}, {0}}));
  const WeightedState one{1, 1};
  const PhaseEstimate estimate = estimator.of({&one, 1}, 0.02f);
  EXPECT_NEAR(estimate.age, 1 / 30.0, 1e-6);
  EXPECT_NEAR(estimate.seen, 0.01 - 1 / 30.0 / 0.8 + 1, 1e-5);
}

}  // namespace
}  // namespace gait
