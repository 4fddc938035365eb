#include "gait/judge/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gait {
namespace {

// Frames whose truth is drawn from softmax(temper * scores).
StyleScores drawn(double temper, int frames, int styles, double spread, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0, static_cast<float>(spread));
  StyleScores scores;
  for (int frame = 0; frame < frames; ++frame) {
    const Eigen::VectorXf score =
        Eigen::VectorXf::NullaryExpr(styles, [&] { return normal(random); });
    std::vector<double> weights;
    for (int style = 0; style < styles; ++style)
      weights.push_back(std::exp(temper * (score[style] - score.maxCoeff())));
    scores.scores.push_back(score);
    scores.truth.push_back(std::discrete_distribution<int>(weights.begin(), weights.end())(random));
  }
  return scores;
}

double log_loss(const StyleScores& scores, double temper) {
  double loss = 0;
  for (std::size_t i = 0; i < scores.truth.size(); ++i) {
    double sum = 0;
    for (const float score : scores.scores[i])
      sum += std::exp(temper * (score - scores.scores[i][scores.truth[i]]));
    loss += std::log(sum);
  }
  return loss;
}

TEST(BestTemper, is_where_a_fine_grid_finds_the_least_loss) {
  for (const double true_temper : {0.003, 0.02, 0.3}) {
    const StyleScores scores = drawn(true_temper, 400, 5, 1 / true_temper, 3);
    double best = 0, least = 1e300;
    for (double temper = 1e-4; temper <= 1; temper *= 1.01)
      if (const double loss = log_loss(scores, temper); loss < least) least = loss, best = temper;
    const double found = best_temper(scores, -1);
    EXPECT_NEAR(found / best, 1, 0.011);
    EXPECT_LE(log_loss(scores, found), least + 1e-9);
    EXPECT_NEAR(found / true_temper, 1, 0.25) << "400 draws know it about so well";
  }
}

TEST(BestTemper, stays_within_the_evidence_of_one_frame) {
  // Never a miss: any temper would do, and more would always look better.
  StyleScores scores;
  for (int i = 0; i < 20; ++i) {
    scores.scores.push_back(Eigen::Vector3f(5, 0, -2));
    scores.truth.push_back(0);
  }
  EXPECT_NEAR(best_temper(scores, -1), 1, 1e-3);
  // Nothing but misses: no evidence at all.
  for (int& truth : scores.truth) truth = 2;
  EXPECT_NEAR(best_temper(scores, -1), 1e-4, 1e-6);
  EXPECT_EQ(best_temper({}, 0.02), 0.02);
}

TEST(CalibrationError, is_small_when_probabilities_come_true) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.2, 1);
  CalibrationError honest, boastful;
  for (int i = 0; i < 20000; ++i) {
    const double probability = uniform(random);
    const bool right = std::bernoulli_distribution(probability)(random);
    honest.add(probability, right);
    boastful.add(std::min(1.0, probability + 0.2), right);
  }
  EXPECT_LT(honest.value(), 0.02);
  EXPECT_NEAR(boastful.value(), 0.18, 0.03);
}

TEST(CalibrationError, is_the_mean_gap_of_the_bins) {
  CalibrationError error;
  EXPECT_EQ(error.value(), 0);
  // Bin of 0.9 to 1: three frames at 0.95, two right. Bin of 0.5 to 0.6: one at 0.55, wrong.
  error.add(0.95, true), error.add(0.95, true), error.add(0.95, false);
  error.add(0.55, false);
  EXPECT_NEAR(error.value(), (3 * std::abs(0.95 - 2.0 / 3) + 0.55) / 4, 1e-12);
  CalibrationError edges;
  edges.add(1, true);
  edges.add(0, false);
  EXPECT_NEAR(edges.value(), 0, 1e-12);
}

}  // namespace
}  // namespace gait
