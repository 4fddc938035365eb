// Whether walks that were synthesised vary as they were told to.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "gait/play/cycles/truncated_normal.h"
#include "play/cycles/styled_walks.h"

namespace gait {
namespace {

using testing::corpus_walks;

constexpr int cycles = 2000, batches = 40;

// Of the density at rest, proportional to phi(z) (Phi(b(z)) - Phi(a(z))) where the next number lies
// between a and b: by the trapezoidal rule, which is exact for such bells.
struct AtRest {
  double mean = 0, deviation = 0;
  AtRest(double limit, double lowest, double highest) {
    constexpr int pieces = 20000;
    double mass = 0, first = 0, second = 0;
    for (int i = 0; i <= pieces; ++i) {
      const double z = lowest + (highest - lowest) * i / pieces;
      const double reach = normal_distribution(std::min(z + limit, highest)) -
                           normal_distribution(std::max(z - limit, lowest));
      const double density = (i == 0 || i == pieces ? 0.5 : 1) * std::exp(-0.5 * z * z) * reach;
      mass += density, first += density * z, second += density * z * z;
    }
    mean = first / mass;
    deviation = std::sqrt(second / mass - mean * mean);
  }
};

// How many standard errors, by batch means, the mean of `values` lies from `wanted`.
double errors_off(const std::vector<double>& values, double wanted) {
  const std::size_t length = values.size() / batches;
  std::vector<double> means(batches, 0);
  for (std::size_t i = 0; i < batches * length; ++i)
    means[i / length] += values[i] / static_cast<double>(length);
  double mean = 0, squares = 0;
  for (const double m : means) mean += m / batches;
  for (const double m : means) squares += (m - mean) * (m - mean);
  return (mean - wanted) / std::sqrt(squares / (batches - 1) / batches);
}

// What a walker drew: per cycle the scores and, last, the duration.
std::vector<Eigen::VectorXd> drawn(StyleWalker& walker) {
  std::vector<Eigen::VectorXd> result;
  while (result.size() < cycles) {
    if (result.size() == static_cast<std::size_t>(walker.cycle())) {
      Eigen::VectorXd cycle(walker.components() + 1);
      cycle << walker.scores().cast<double>(), walker.duration();
      result.push_back(cycle);
    }
    walker.advance(0.3 * walker.duration());
  }
  return result;
}

// Student's t with 39 degrees of freedom is beyond this with a chance of 1e-2 / 1600 (both sides):
// all some 1000 tests together are wrong in less than one case of a hundred.
constexpr double t_limit = 5.2;

TEST(StyleWalkerStatistics, scores_and_durations_are_those_of_the_density_at_rest) {
  const Model& model = *corpus_walks().model;
  int tests = 0;
  double largest = 0;
  for (std::size_t style = 0; style < model.styles.size(); ++style) {
    StyleWalker walker(corpus_walks().model, 100 + style);
    ASSERT_TRUE(walker.set_style(static_cast<int>(style)));
    const std::vector<Eigen::VectorXd> walked = drawn(walker);
    const StyleCycles& told = model.style_space->styles[style];
    for (int i = 0; i <= walker.components(); ++i) {
      const bool duration = i == walker.components();
      const Variation& variation = duration ? told.duration : told.scores[i];
      const double sigma = variation.deviation;
      const AtRest wanted(variation.largest_change / sigma,
                          duration ? (0.9 * variation.lowest - variation.mean) / sigma : -8.0,
                          duration ? (1.1 * variation.highest - variation.mean) / sigma : 8.0);
      std::vector<double> z, squares;
      for (const Eigen::VectorXd& cycle : walked) {
        z.push_back((cycle[i] - variation.mean) / sigma);
        squares.push_back((z.back() - wanted.mean) * (z.back() - wanted.mean));
      }
      for (const double off :
           {errors_off(z, wanted.mean), errors_off(squares, wanted.deviation * wanted.deviation)}) {
        EXPECT_LT(std::abs(off), t_limit) << model.styles[style] << ", score " << i;
        largest = std::max(largest, std::abs(off));
        ++tests;
      }
    }
  }
  EXPECT_LT(tests, 1600);
  RecordProperty("tests", tests);
  RecordProperty("largest", std::to_string(largest));
}

TEST(StyleWalkerStatistics, no_score_changes_by_more_than_it_ever_did_and_no_two_cycles_are_equal) {
  const Model& model = *corpus_walks().model;
  for (std::size_t style = 0; style < model.styles.size(); ++style) {
    StyleWalker walker(corpus_walks().model, 200 + style);
    walker.set_style(static_cast<int>(style));
    const std::vector<Eigen::VectorXd> walked = drawn(walker);
    const StyleCycles& told = model.style_space->styles[style];
    std::set<std::vector<double>> seen;
    for (std::size_t k = 0; k < walked.size(); ++k) {
      EXPECT_TRUE(seen.insert({walked[k].begin(), walked[k].end()}).second);
      const double duration = walked[k][walker.components()];
      EXPECT_GE(duration, 0.9 * told.duration.lowest - 1e-5);
      EXPECT_LE(duration, 1.1 * told.duration.highest + 1e-5);
      if (k == 0) continue;
      for (int i = 0; i <= walker.components(); ++i) {
        const double limit =
            i == walker.components() ? told.duration.largest_change : told.scores[i].largest_change;
        EXPECT_LE(std::abs(walked[k][i] - walked[k - 1][i]), limit + 1e-4);  // float's rounding
      }
    }
  }
}

// Frame by frame, not by what the walker says of itself.
TEST(StyleWalkerStatistics, cycles_last_as_long_as_they_were_drawn) {
  StyleWalker walker(corpus_walks().model, 5);
  walker.set_style(testing::style_named(*corpus_walks().model, "drunk"));
  double last = 0;
  float drawn = walker.duration();
  for (int frame = 1; frame < 6000; ++frame) {
    ASSERT_TRUE(walker.advance(1 / 60.0));
    if (walker.contact() != Foot::right) continue;
    const double now = frame / 60.0 - walker.since_contact();
    EXPECT_NEAR(now - last, drawn, 1e-4);
    last = now, drawn = walker.duration();
  }
  EXPECT_GT(walker.cycle(), 50);
}

TEST(StyleWalkerStatistics, variation_scales_deviations_and_limits_alike) {
  const Model& model = *corpus_walks().model;
  const int style = testing::style_named(model, "drunk");
  const StyleCycles& told = model.style_space->styles[style];
  for (const float variation : {0.5f, 2.0f}) {
    StyleWalker walker(corpus_walks().model, 11);
    walker.set_style(style);
    walker.set_variation(variation);
    const std::vector<Eigen::VectorXd> walked = drawn(walker);
    for (int i = 0; i < walker.components(); ++i) {
      const double sigma = told.scores[i].deviation;
      const AtRest wanted(told.scores[i].largest_change / sigma, -8, 8);
      std::vector<double> squares;
      for (const Eigen::VectorXd& cycle : walked)
        squares.push_back(std::pow((cycle[i] - told.scores[i].mean) / sigma / variation, 2));
      EXPECT_LT(std::abs(errors_off(squares, wanted.deviation * wanted.deviation)), t_limit);
    }
    for (std::size_t k = 1; k < walked.size(); ++k)
      for (int i = 0; i < walker.components(); ++i)
        EXPECT_LE(std::abs(walked[k][i] - walked[k - 1][i]),
                  variation * told.scores[i].largest_change + 1e-4);
  }
}

}  // namespace
}  // namespace gait
