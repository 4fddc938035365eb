#include "gait/play/change/style_mix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gait {
namespace {

StyleMix mix() { return StyleMix({true, true, true, false}, Eigen::Vector4f(1, 1, 1, 0) / 3); }

void expect_weights(const StyleMix& mix, float a, float b, float c, float tolerance = 1e-6f) {
  EXPECT_NEAR(mix.weights()[0], a, tolerance);
  EXPECT_NEAR(mix.weights()[1], b, tolerance);
  EXPECT_NEAR(mix.weights()[2], c, tolerance);
}

TEST(StyleMix, weights_are_normalised) {
  StyleMix m = mix();
  const float weights[] = {6, 2, 0, 0};
  ASSERT_TRUE(m.set(weights));
  m.arrive();
  expect_weights(m, 0.75f, 0.25f, 0);
}

TEST(StyleMix, weights_that_mean_nothing_change_nothing) {
  StyleMix m = mix();
  ASSERT_TRUE(m.set_only(1));
  m.arrive();
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              inf = std::numeric_limits<float>::infinity();
  for (const std::array<float, 4>& weights : {std::array<float, 4>{-1, 2, 0, 0},
                                              {0, 0, 0, 0},
                                              {nan, 1, 0, 0},
                                              {inf, 1, 0, 0},
                                              {0, 0, 0, 1},
                                              {1, 0, 0, 0.1f}})
    EXPECT_FALSE(m.set(weights));
  EXPECT_FALSE(m.set(std::array<float, 2>{1, 1}));
  for (const int style : {-1, 3, 4, 99}) EXPECT_FALSE(m.set_only(style));
  m.arrive();
  expect_weights(m, 0, 1, 0);
}

TEST(StyleMix, takes_about_one_step_to_another_style) {
  StyleMix m = mix();
  m.set_only(0);
  m.arrive();
  m.set_only(2);
  const float frame = 0.5f / 16;  // sixteen frames a step
  for (int i = 0; i < 4; ++i) m.advance(frame);
  EXPECT_GT(m.weights()[0], 0.2f);
  for (int i = 4; i < 16; ++i) m.advance(frame);
  EXPECT_GT(m.weights()[2], 0.95f);
  for (int i = 0; i < 16; ++i) m.advance(frame);
  expect_weights(m, 0, 0, 1, 1e-3f);
  for (int i = 0; i < 100; ++i) m.advance(frame);
  EXPECT_EQ(m.weights()[0], 0);  // nothing is left, not even a denormal number
}

TEST(StyleMix, passes_neutral_on_the_way_if_told_to) {
  for (const bool through : {false, true}) {
    StyleMix m = mix();
    m.set_through_neutral(through);
    m.set_only(0);
    m.arrive();
    m.set_only(2);
    float most_of_other = 0, last = 0;
    for (int i = 0; i < 64; ++i) {
      m.advance(0.5f / 64);
      most_of_other = std::max(most_of_other, m.weights()[1]);
      last = m.weights()[2];
    }
    if (through)
      EXPECT_GT(most_of_other, 0.25f);
    else
      EXPECT_EQ(most_of_other, 0);
    EXPECT_GT(last, 0.9f);
  }
}

// Whatever is asked and however often: weights stay weights, and none jumps.
TEST(StyleMix, never_jumps) {
  std::mt19937 random(8);
  StyleMix m = mix();
  Eigen::VectorXf before = m.weights(), speed = Eigen::VectorXf::Zero(4);
  const float frame = 0.5f / 60;  // 60 frames a step
  for (int i = 0; i < 5000; ++i) {
    if (random() % 20 == 0) m.set_only(static_cast<int>(random() % 3));
    if (random() % 30 == 0) m.set_through_neutral(random() % 2 == 0);
    m.advance(frame);
    EXPECT_GE(m.weights().minCoeff(), 0);
    EXPECT_NEAR(m.weights().sum(), 1, 1e-5f);
    const Eigen::VectorXf now = m.weights() - before;
    // The step response of two equal lags rises by at most 6 / e of the way per step's length,
    // twice that through neutral; its speed comes to that no faster than one lag allows.
    EXPECT_LT(now.cwiseAbs().maxCoeff(), 2 * 6 / 2.718f / 60);
    EXPECT_LT((now - speed).cwiseAbs().maxCoeff(), 2 * 2 * 6 / 60.0f * (2 * 6 / 60.0f));
    before = m.weights(), speed = now;
  }
}

// A slider moved in every frame must not wait for the hand to rest.
TEST(StyleMix, follows_a_slider_that_never_rests) {
  StyleMix m = mix();
  m.set_only(0);
  m.arrive();
  for (int i = 0; i <= 300; ++i) {
    const float share = static_cast<float>(i) / 300;
    m.set(std::array<float, 4>{1 - share, share, 0, 0});
    m.advance(0.5f / 30);  // ten steps in all
    EXPECT_NEAR(m.weights()[1], share, 0.05f);
  }
}

}  // namespace
}  // namespace gait
