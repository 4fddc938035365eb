#include "gait/motion/steps.h"

#include <gtest/gtest.h>

namespace gait {
namespace {

constexpr Foot right = Foot::right, left = Foot::left;

TEST(Steps, go_from_one_foots_contact_to_the_others) {
  const auto steps = steps_between({{10, right}, {25, left}, {41, right}});
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].begin, 10);
  EXPECT_EQ(steps[0].end, 25) << "the contact's frame belongs to the new step";
  EXPECT_EQ(steps[0].foot, right) << "a step bears the name of the foot that begins it";
  EXPECT_EQ(steps[1].begin, 25);
  EXPECT_EQ(steps[1].foot, left);
}

TEST(Steps, a_foot_that_touches_twice_makes_no_step_between) {
  const auto steps = steps_between({{0, right}, {10, left}, {20, left}, {30, right}});
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[0].end, 10);
  EXPECT_EQ(steps[1].begin, 20);
  EXPECT_TRUE(steps_between({}).empty());
  EXPECT_TRUE(steps_between({{5, left}}).empty());
}

TEST(Cycles, go_from_right_contact_to_right_contact_over_a_left_one) {
  const auto cycles =
      cycles_between({{5, left}, {20, right}, {35, left}, {50, right}, {66, left}, {80, right}});
  ASSERT_EQ(cycles.size(), 2u);
  EXPECT_EQ(cycles[0].begin, 20);
  EXPECT_EQ(cycles[0].end, 50);
  EXPECT_EQ(cycles[1].begin, 50);
  EXPECT_EQ(cycles[1].end, 80);
  EXPECT_TRUE(cycles_between({{0, right}, {10, right}, {20, right}}).empty());
  EXPECT_TRUE(cycles_between({{0, left}, {10, right}, {20, left}}).empty());
}

TEST(Feet, have_names_and_another) {
  EXPECT_EQ(foot_name(right), "right");
  EXPECT_EQ(foot_name(left), "left");
  EXPECT_EQ(other(right), left);
  EXPECT_EQ(other(left), right);
}

}  // namespace
}  // namespace gait
