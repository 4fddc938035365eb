#include "gait/motion/observation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gait {
namespace {

Eigen::MatrixXd random_values(int values, int frames, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(values, frames, [&] { return normal(random); });
}

Scaling scaling_for(const InputLayout& layout) {
  Scaling scaling{Eigen::VectorXd(layout.size()), Eigen::VectorXd(layout.size())};
  for (int i = 0; i < layout.size(); ++i) {
    scaling.mean[i] = 0.1 * i - 0.3;
    scaling.deviation[i] = 0.2 + 0.05 * i;
  }
  return scaling;
}

TEST(Observation, is_the_moving_values_and_how_they_changed_since_some_frames_ago) {
  const InputLayout layout{5, {0, 3, 4}, {1, 5, 10}};
  EXPECT_EQ(layout.statics(), 3);
  EXPECT_EQ(layout.size(), 12);
  const Scaling scaling = scaling_for(layout);
  InputObserver<double> observer(layout, scaling);
  const Eigen::MatrixXd values = random_values(5, 60, 1);
  for (int frame = 0; frame < 60; ++frame) {
    observer.advance({values.col(frame).data(), 5});
    int known = 3;
    for (int lag = 0; lag < 3; ++lag)
      if (layout.lags[lag] <= frame) known += 3;
    ASSERT_EQ(observer.known(), known) << "frame " << frame;
    for (int entry = 0; entry < known; ++entry) {
      const int value = layout.modelled[entry % 3];
      const double raw =
          entry < 3 ? values(value, frame)
                    : values(value, frame) - values(value, frame - layout.lags[entry / 3 - 1]);
      EXPECT_EQ(observer.raw()[entry], raw);
      EXPECT_EQ(observer.scaled()[entry],
                (raw - scaling.mean[entry]) * (1 / scaling.deviation[entry]));
    }
    EXPECT_TRUE(observer.scaled().allFinite()) << "what is not known yet is a number all the same";
  }
}

TEST(Observation, knows_no_more_than_has_happened) {
  const InputLayout layout{2, {0, 1}, {1, 5, 10}};
  EXPECT_EQ(layout.known(0), 2);
  EXPECT_EQ(layout.known(1), 4);
  EXPECT_EQ(layout.known(4), 4);
  EXPECT_EQ(layout.known(5), 6);
  EXPECT_EQ(layout.known(9), 6);
  EXPECT_EQ(layout.known(10), 8);
  EXPECT_EQ(layout.known(1000), 8);
}

TEST(Observation, is_nearly_the_same_in_the_players_single_precision) {
  const InputLayout layout{4, {0, 1, 2, 3}, {1, 5, 10}};
  const Scaling scaling = scaling_for(layout);
  InputObserver<double> learning(layout, scaling);
  InputObserver<float> playing(layout, scaling);
  const Eigen::MatrixXd values = random_values(4, 100, 2);
  const Eigen::MatrixXf single = values.cast<float>();
  for (int frame = 0; frame < 100; ++frame) {
    learning.advance({values.col(frame).data(), 4});
    playing.advance({single.col(frame).data(), 4});
    EXPECT_EQ(learning.known(), playing.known());
    // Values of about 3 over deviations from 0.2: rounding to 24 bits, a few times over.
    EXPECT_LT((learning.scaled() - playing.scaled().cast<double>()).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(Observation, after_a_reset_reaches_into_nothing_that_was_before) {
  const InputLayout layout{3, {0, 2}, {2, 4}};
  InputObserver<float> used(layout, scaling_for(layout)), fresh(layout, scaling_for(layout));
  const Eigen::MatrixXf before = 100 * random_values(3, 17, 3).cast<float>();
  const Eigen::MatrixXf after = random_values(3, 12, 4).cast<float>();
  for (int frame = 0; frame < 17; ++frame) used.advance({before.col(frame).data(), 3});
  used.reset();
  EXPECT_EQ(used.known(), 0);
  for (int frame = 0; frame < 12; ++frame) {
    used.advance({after.col(frame).data(), 3});
    fresh.advance({after.col(frame).data(), 3});
    EXPECT_EQ(used.known(), fresh.known());
    EXPECT_EQ(used.scaled(), fresh.scaled());
  }
}

TEST(Observation, without_history_is_the_frame_itself) {
  const InputLayout layout{2, {0, 1}, {}};
  InputObserver<double> observer(layout, {Eigen::Vector2d(1, 2), Eigen::Vector2d(2, 4)});
  const double values[] = {5, 10};
  observer.advance(values);
  EXPECT_EQ(observer.known(), 2);
  EXPECT_EQ(observer.scaled(), Eigen::Vector2d(2, 2));
}

TEST(Observation, clips_what_moves_more_than_was_taught_and_nothing_else) {
  InputLayout layout{4, {0, 1, 2, 3}, {}};
  const Scaling none{Eigen::Vector4d::Zero(), Eigen::Vector4d::Ones()};
  const double values[] = {0.5, -4.5, 1, 3};
  InputObserver<double> unclipped(layout, none);
  unclipped.advance(values);
  EXPECT_FALSE(unclipped.clipped());
  EXPECT_EQ(unclipped.scaled(), Eigen::Vector4d(0.5, -4.5, 1, 3));

  layout.clip = 3.5;
  InputObserver<double> clipping(layout, none);
  clipping.advance(values);
  EXPECT_TRUE(clipping.clipped());
  EXPECT_NEAR(clipping.scaled()[1], -3.5, 0.4) << "the whole is hardly further off than usual";
  EXPECT_EQ(clipping.scaled()[0], 0.5);
  EXPECT_EQ(clipping.scaled()[3], 3);
  EXPECT_EQ(clipping.unclipped(), unclipped.scaled());
  EXPECT_EQ(clipping.raw(), unclipped.raw());
}

TEST(Observation, as_the_whole_leaves_what_was_taught_what_deviates_most_counts_least) {
  InputLayout layout{2, {0, 1}, {}};
  layout.clip = 3.5;
  InputObserver<float> observer(layout, {Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones()});
  float before = 0;
  for (const float entry : {1.0f, 3.0f, 3.5f, 3.6f, 5.0f, 8.0f, 20.0f, 100.0f, 1e4f}) {
    const float values[] = {entry, -1};
    observer.advance(values);
    const float left = observer.scaled()[0];
    EXPECT_EQ(observer.scaled()[1], -1);
    EXPECT_LE(left, 3.5f);
    EXPECT_GT(left, 0);
    EXPECT_LT(std::abs(left - before), 2.1f) << "without a jump at " << entry;
    if (entry >= 20) {
      EXPECT_LT(left, 0.2f) << entry;
    }
    before = left;
  }
}

}  // namespace
}  // namespace gait
