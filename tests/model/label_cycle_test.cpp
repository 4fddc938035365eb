#include "gait/model/label_cycle.h"

#include <gtest/gtest.h>

namespace gait {
namespace {

// Labels of two states of 0.2 s each.
Model model_of(const std::vector<std::vector<int>>& successors) {
  Model model;
  for (const auto& next : successors) {
    Label label;
    label.successors = next;
    label.states.assign(2, {});
    for (State& state : label.states) state.duration = 0.2;
    model.labels.push_back(label);
  }
  return model;
}

TEST(LabelCycle, labels_that_follow_each_other_share_a_cycle) {
  const auto cycles = label_cycles(model_of({{2}, {0}, {1}}));
  ASSERT_EQ(cycles.size(), 3u);
  for (const LabelCycle& cycle : cycles) {
    EXPECT_EQ(cycle.ring, 0);
    EXPECT_EQ(cycle.labels, 3);
    EXPECT_NEAR(cycle.cadence(), 2.5, 1e-5);
  }
  EXPECT_EQ(cycles[0].begin(), 0);
  EXPECT_NEAR(cycles[2].begin(), 1.0 / 3, 1e-6);
  EXPECT_NEAR(cycles[1].begin(), 2.0 / 3, 1e-6);
}

TEST(LabelCycle, labels_outside_rings_are_cycles_of_their_own) {
  // Into a ring, at a fork, at an end, and after itself.
  const auto cycles = label_cycles(model_of({{1}, {2}, {1}, {0, 1}, {}, {5}}));
  for (const int alone : {0, 3, 4, 5}) {
    EXPECT_EQ(cycles[alone].ring, alone);
    EXPECT_EQ(cycles[alone].labels, 1);
    EXPECT_NEAR(cycles[alone].cadence(), 2.5, 1e-5);
  }
  for (const int together : {1, 2}) EXPECT_EQ(cycles[together].labels, 2);
}

TEST(LabelCycle, without_durations_has_no_cadence) {
  Model model = model_of({{0}});
  for (State& state : model.labels[0].states) state.duration = 0;
  EXPECT_EQ(label_cycles(model)[0].cadence(), 0);
}

}  // namespace
}  // namespace gait
