#include "gait/learn/style_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "gait/error.h"

namespace gait {
namespace {

// Cycles of two frames and two joints, 12 values, in `walks` walks of each style.
std::vector<CapturedCycle> random_cycles(const std::vector<int>& cycles_of_walk) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<CapturedCycle> cycles;
  for (std::size_t walk = 0; walk < cycles_of_walk.size(); ++walk)
    for (int place = 0; place < cycles_of_walk[walk]; ++place) {
      CapturedCycle cycle;
      cycle.values = Eigen::VectorXd::NullaryExpr(12, [&] { return normal(random); });
      cycle.values[0] += 3.0 * static_cast<double>(walk / 2);
      cycle.duration = 1 + 0.05 * normal(random);
      cycle.walk = static_cast<int>(walk);
      cycle.place = place;
      cycles.push_back(cycle);
    }
  return cycles;
}

const std::vector<int> cycles_of_walk{4, 3, 5, 6}, style_of_walk{0, 0, 1, 1}, joints{0, 1};

StyleSpace learnt(const std::vector<CapturedCycle>& cycles, const ComponentChoice& choice = {}) {
  return learn_style_space(cycles, style_of_walk, 2, joints, 2, choice);
}

TEST(StyleSpace, is_fitted_to_as_many_cycles_of_each_style_and_learns_from_all) {
  const StyleSpace space = learnt(random_cycles(cycles_of_walk));
  EXPECT_EQ(space.cycles_per_style, 7);
  EXPECT_EQ(space.styles[0].cycles, 7);
  EXPECT_EQ(space.styles[1].cycles, 11);
  EXPECT_EQ(space.space.variances.size(), 12);  // of 14 cycles
}

TEST(StyleSpace, gives_its_cycles_back_when_all_components_are_kept) {
  const auto cycles = random_cycles(cycles_of_walk);
  const CycleSpace space = learnt(cycles, {.count = 12}).space;
  for (const CapturedCycle& cycle : cycles) {
    const Eigen::VectorXd scores = space.components.transpose() * (cycle.values - space.mean);
    EXPECT_LT((space.mean + space.components * scores - cycle.values).norm(), 1e-9);
  }
}

TEST(StyleSpace, knows_mean_deviation_range_and_largest_change_of_each_score) {
  const auto cycles = random_cycles(cycles_of_walk);
  const StyleSpace space = learnt(cycles, {.count = 5});
  for (int style = 0; style < 2; ++style)
    for (int i = 0; i <= 5; ++i) {
      double sum = 0, squares = 0, lowest = 1e9, highest = -1e9, change = 0, before = 0;
      int count = 0;
      for (const CapturedCycle& cycle : cycles) {
        if (style_of_walk[cycle.walk] != style) continue;
        const double value =
            i == 5 ? cycle.duration
                   : space.space.components.col(i).dot(cycle.values - space.space.mean);
        sum += value, squares += value * value, ++count;
        lowest = std::min(lowest, value), highest = std::max(highest, value);
        if (cycle.place > 0) change = std::max(change, std::abs(value - before));
        before = value;
      }
      const Variation& found =
          i == 5 ? space.styles[style].duration : space.styles[style].scores[i];
      const double mean = sum / count;
      EXPECT_NEAR(found.mean, mean, 1e-12);
      EXPECT_NEAR(found.deviation, std::sqrt((squares - count * mean * mean) / (count - 1)), 1e-9);
      EXPECT_NEAR(found.largest_change, change, 1e-12);
      EXPECT_NEAR(found.lowest, lowest, 1e-12);
      EXPECT_NEAR(found.highest, highest, 1e-12);
    }
}

TEST(StyleSpace, neighbours_are_neither_cycles_of_two_walks_nor_those_around_a_turn) {
  auto cycles = random_cycles({2, 1, 3, 1});
  for (CapturedCycle& cycle : cycles) cycle.duration = 1;
  cycles[0].duration = 1.1, cycles[1].duration = 1.13;  // neighbours of style 0
  cycles[2].duration = 2;                               // another walk
  cycles[4].straight = false;                           // style 1: between its first and third
  cycles[3].duration = 1, cycles[5].duration = 1.5, cycles[6].duration = 1.2;
  const StyleSpace space = learnt(cycles);
  EXPECT_NEAR(space.styles[0].duration.largest_change, 0.03, 1e-12);
  // No neighbours at all: free within what was seen.
  EXPECT_NEAR(space.styles[1].duration.largest_change, 0.5, 1e-12);
  EXPECT_EQ(space.styles[1].cycles, 3);
}

TEST(StyleSpace, leaves_out_a_style_that_never_walks_straight) {
  auto cycles = random_cycles(cycles_of_walk);
  for (CapturedCycle& cycle : cycles)
    if (style_of_walk[cycle.walk] == 1) cycle.straight = false;
  const StyleSpace space = learnt(cycles);
  EXPECT_EQ(space.styles[0].cycles, 7);
  EXPECT_EQ(space.styles[1].cycles, 0);
  EXPECT_EQ(space.cycles_per_style, 7);
  EXPECT_EQ(space.styles[1].scores.size(), space.styles[0].scores.size());
}

TEST(StyleSpace, is_not_learnt_from_a_single_cycle) {
  EXPECT_THROW(learnt(random_cycles({1, 0, 0, 0})), Error);
  EXPECT_THROW(learnt({}), Error);
}

}  // namespace
}  // namespace gait
