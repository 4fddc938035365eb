#include "gait/play/recognise/table_maker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "play/random_model.h"

namespace gait {
namespace {

using testing::random_model;

bool finishes(const TableMaker& maker) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!maker.finished()) {
    if (std::chrono::steady_clock::now() > give_up) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  return true;
}

bool becomes_free(TableMaker& maker, const std::vector<bool>& missing) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!maker.ask(missing)) {
    if (std::chrono::steady_clock::now() > give_up) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  return true;
}

void expect_same(const StateTables& a, const StateTables& b) {
  EXPECT_EQ(a.kept, b.kept);
  EXPECT_EQ(a.depths, b.depths);
  EXPECT_EQ(a.first_state, b.first_state);
  EXPECT_EQ(a.successors, b.successors);
  EXPECT_EQ(a.label_duration, b.label_duration);
  ASSERT_EQ(a.states.size(), b.states.size());
  for (std::size_t i = 0; i < a.states.size(); ++i) {
    EXPECT_EQ(a.states[i].whitener, b.states[i].whitener);
    EXPECT_EQ(a.states[i].log_constant, b.states[i].log_constant);
    EXPECT_EQ(a.states[i].gain, b.states[i].gain);
    EXPECT_EQ(a.states[i].explained_variance, b.states[i].explained_variance);
    EXPECT_EQ(a.states[i].style_scores, b.states[i].style_scores);
  }
}

TEST(TableMaker, makes_the_tables_that_were_asked_for) {
  const auto model = std::make_shared<const Model>(random_model());
  TableMaker maker(model);
  auto current = make_state_tables(*model);
  EXPECT_FALSE(maker.finished());
  EXPECT_EQ(maker.ready(), nullptr);
  EXPECT_FALSE(maker.take(current));
  for (const std::vector<bool>& missing : {std::vector<bool>{true, false, false, false, false},
                                           {false, true, true, false, true},
                                           {false, false, false, false, false}}) {
    ASSERT_TRUE(becomes_free(maker, missing));
    ASSERT_TRUE(finishes(maker));
    EXPECT_FALSE(maker.ask(missing)) << "its result was not taken yet";
    const auto seen = maker.ready();
    ASSERT_TRUE(maker.take(current));
    EXPECT_EQ(seen, current);
    EXPECT_EQ(maker.ready(), nullptr);
    expect_same(*current, *make_state_tables(*model, missing));
  }
}

TEST(TableMaker, frees_old_tables_itself) {
  const auto model = std::make_shared<const Model>(random_model());
  auto current = make_state_tables(*model);
  const std::weak_ptr<const StateTables> old = current;
  TableMaker maker(model);
  ASSERT_TRUE(maker.ask({true, false, false, false, false}));
  ASSERT_TRUE(finishes(maker));
  ASSERT_TRUE(maker.take(current));
  // It takes another request only when that is done.
  ASSERT_TRUE(becomes_free(maker, {false, true, false, false, false}));
  EXPECT_TRUE(old.expired());
}

TEST(TableMaker, keeps_the_old_tables_when_nothing_is_left_to_see) {
  const auto model = std::make_shared<const Model>(random_model());
  TableMaker maker(model);
  auto current = make_state_tables(*model);
  const auto before = current;
  ASSERT_TRUE(maker.ask(std::vector<bool>(5, true)));
  ASSERT_TRUE(finishes(maker));
  EXPECT_EQ(maker.ready(), nullptr);
  EXPECT_FALSE(maker.take(current));
  EXPECT_EQ(current, before);
  // And works on.
  ASSERT_TRUE(becomes_free(maker, {true, false, false, false, false}));
  ASSERT_TRUE(finishes(maker));
  EXPECT_TRUE(maker.take(current));
}

TEST(TableMaker, can_go_at_any_moment) {
  const auto model = std::make_shared<const Model>(random_model({.inputs = 3, .states = {1, 1}}));
  const std::vector<bool> missing{true, false, false};
  for (int round = 0; round < 20; ++round)
    for (int moment = 0; moment < 6; ++moment) {
      auto current = make_state_tables(*model);
      TableMaker maker(model);
      if (moment == 0) continue;  // never asked
      ASSERT_TRUE(maker.ask(missing));
      if (moment == 1) continue;  // just asked
      if (moment == 2) {          // somewhere in its work
        for (int i = 0; i < round; ++i) std::this_thread::yield();
        continue;
      }
      ASSERT_TRUE(finishes(maker));
      if (moment == 3) continue;  // done, not taken
      ASSERT_TRUE(maker.take(current));
      if (moment == 4) continue;  // freeing
      ASSERT_TRUE(becomes_free(maker, missing));
    }
}

}  // namespace
}  // namespace gait
