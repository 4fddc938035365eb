#include "gait/play/recognise/style_recogniser.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "play/random_model.h"

namespace gait {
namespace {

using testing::entries_there;
using testing::random_model;
using testing::random_vector;
using testing::state_of;

// log N(x; mean of the style, shared covariance) up to what all styles share.
Eigen::VectorXd log_likelihoods(const State& state, const Eigen::VectorXf& x,
                                const std::vector<int>& there) {
  const Eigen::MatrixXd covariance = state.style_covariance(there, there);
  Eigen::VectorXd result(state.style_means.cols());
  for (Eigen::Index style = 0; style < result.size(); ++style) {
    const Eigen::VectorXd from_mean = x.cast<double>()(there) - state.style_means.col(style)(there);
    result[style] = -0.5 * from_mean.dot(covariance.fullPivLu().solve(from_mean));
  }
  return result;
}

Eigen::VectorXd softmax(const Eigen::VectorXd& scores) {
  const Eigen::VectorXd e = (scores.array() - scores.maxCoeff()).exp();
  return e / e.sum();
}

TEST(StyleRecogniser, without_memory_gives_each_frames_bayesian_posteriors) {
  Model model = random_model({.styles = 4});
  model.play.style_temper = 0.4;
  const std::vector<bool> missing{false, true, false, false, false};
  for (const auto& mask : {std::vector<bool>{}, missing}) {
    StyleRecogniser recogniser(model, make_state_tables(model, mask));
    recogniser.set_memory(0);
    for (unsigned seed = 0; seed < 20; ++seed)
      for (int past = 0; past <= 3; ++past) {
        const Eigen::VectorXf x = random_vector(model.input.size(), seed);
        const std::vector<WeightedState> states{{1, 0.7f}, {4, 0.3f}};
        const int known = model.input.known(past);
        recogniser.advance(states, x, known);
        const auto there = entries_there(model, known, mask);
        // A constant per state and frame that all styles share goes away in the softmax.
        const Eigen::VectorXd expected =
            softmax(0.4 * (0.7 * log_likelihoods(state_of(model, 1), x, there) +
                           0.3 * log_likelihoods(state_of(model, 4), x, there)));
        const auto said = recogniser.posteriors();
        ASSERT_EQ(said.size(), 4u);
        for (int style = 0; style < 4; ++style) EXPECT_NEAR(said[style], expected[style], 2e-4);
        int best = 0;
        expected.maxCoeff(&best);
        EXPECT_NEAR(said[recogniser.best()], expected[best], 2e-4);
      }
  }
}

TEST(StyleRecogniser, posteriors_always_sum_to_one) {
  const Model model = random_model({.styles = 5});
  StyleRecogniser recogniser(model, make_state_tables(model));
  const auto sum = [&] {
    const auto said = recogniser.posteriors();
    return std::accumulate(said.begin(), said.end(), 0.0);
  };
  EXPECT_NEAR(sum(), 1, 1e-6);
  for (unsigned seed = 0; seed < 100; ++seed) {
    const WeightedState state{static_cast<int>(seed % 5), 1};
    // Also far from everything that was taught.
    recogniser.advance({&state, 1}, random_vector(model.input.size(), seed, 100),
                       model.input.size());
    EXPECT_NEAR(sum(), 1, 1e-5);
  }
}

// Frames until the recogniser follows a change of style.
int frames_to_follow(double memory) {
  const Model model = random_model({.styles = 3});
  StyleRecogniser recogniser(model, make_state_tables(model));
  recogniser.set_memory(static_cast<float>(memory));
  const WeightedState state{2, 1};
  const auto walk = [&](int style) {
    const Eigen::VectorXf x =
        state_of(model, 2).style_means.col(style).head(model.input.size()).cast<float>();
    recogniser.advance({&state, 1}, x, model.input.size());
  };
  for (int i = 0; i < 300; ++i) walk(0);
  EXPECT_EQ(recogniser.best(), 0);
  for (int i = 1; i < 600; ++i) {
    walk(1);
    if (recogniser.best() == 1) return i;
  }
  return 600;
}

TEST(StyleRecogniser, follows_a_change_the_later_the_longer_it_remembers) {
  EXPECT_EQ(frames_to_follow(0), 1);
  const int half = frames_to_follow(0.5), second = frames_to_follow(1), two = frames_to_follow(2);
  EXPECT_LT(half, second);
  EXPECT_LT(second, two);
  // Half of the old style is forgotten after ln 2 of the memory.
  EXPECT_GT(second, 5);
  EXPECT_LT(second, 60);
}

TEST(StyleRecogniser, is_less_sure_of_one_frame_the_longer_it_remembers) {
  Model model = random_model({.styles = 3});
  model.play.style_temper = 1;
  const WeightedState state{0, 1};
  const Eigen::VectorXf x = random_vector(model.input.size(), 8);
  float before = 2;
  for (const float memory : {0.0f, 0.2f, 1.0f, 5.0f}) {
    StyleRecogniser recogniser(model, make_state_tables(model));
    recogniser.set_memory(memory);
    recogniser.advance({&state, 1}, x, model.input.size());
    const float surest = recogniser.posteriors()[recogniser.best()];
    EXPECT_LT(surest, before) << memory;
    before = surest;
  }
  EXPECT_GT(before, 1.0f / 3);
}

TEST(StyleRecogniser, knows_nothing_at_first_and_after_a_reset_and_nothing_without_styles) {
  const Model model = random_model({.styles = 4});
  StyleRecogniser recogniser(model, make_state_tables(model));
  const WeightedState state{0, 1};
  recogniser.advance({&state, 1}, random_vector(model.input.size(), 1), model.input.size());
  recogniser.reset();
  for (const float posterior : recogniser.posteriors()) EXPECT_FLOAT_EQ(posterior, 0.25f);

  const Model plain = random_model({.styles = 0});
  StyleRecogniser none(plain, make_state_tables(plain));
  none.advance({&state, 1}, random_vector(plain.input.size(), 1), plain.input.size());
  EXPECT_TRUE(none.posteriors().empty());
  EXPECT_EQ(none.best(), -1);
}

}  // namespace
}  // namespace gait
