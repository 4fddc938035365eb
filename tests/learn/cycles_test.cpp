#include "gait/learn/cycles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "gait/corpus/corpus.h"
#include "gait/error.h"
#include "gait/motion/contacts.h"
#include "gait/motion/rotation.h"

namespace gait {
namespace {

Walk built_in(const std::string& style, int take, int cycles, double frame_rate = 30) {
  WalkPlan plan;
  plan.style = corpus_style(style);
  plan.take = take;
  plan.cycles = cycles;
  CorpusWalk walk = make_walk(plan, frame_rate);
  return {std::move(walk.clip), walk.style, {}, {}, std::move(walk.contacts)};
}

Body body_of(const std::vector<Walk>& walks) { return walk_sequences(walks, {}).body; }

TEST(Cycles, of_the_built_in_walks_are_as_many_as_T10_counts) {
  std::vector<Walk> walks;
  for (CorpusWalk& walk : make_corpus())
    walks.push_back({std::move(walk.clip), walk.style, {}, {}, std::move(walk.contacts)});
  std::map<std::string, int> counted;
  for (const CapturedCycle& cycle : cut_cycles(walks, body_of(walks), 40)) {
    EXPECT_TRUE(cycle.straight);
    EXPECT_EQ(cycle.values.size(), 2160);
    ++counted[walks[cycle.walk].style];
  }
  const std::map<std::string, int> table_1{{"proud", 21},    {"decided", 15},   {"sad", 31},
                                           {"cat-walk", 25}, {"drunk", 38},     {"cool", 23},
                                           {"afraid", 16},   {"tiptoeing", 18}, {"heavy", 23},
                                           {"manly", 18},    {"in-a-hurry", 19}};
  EXPECT_EQ(counted, table_1);
}

TEST(Cycles, begin_at_the_right_contact_and_are_half_done_at_the_left) {
  const std::vector<Walk> walks{built_in("drunk", 1, 4)};
  const Body body = body_of(walks);
  const std::vector<int> joints = joints_below_hips(body);
  const std::vector<CapturedCycle> cycles = cut_cycles(walks, body, 40);
  const BodyPoses poses =
      body_poses(walks[0].clip, body, match_joints(body, walks[0].clip.skeleton, "walk"),
                 follow_walk(walks[0].clip, find_roles(walks[0].clip.skeleton)).cycle_seconds);
  ASSERT_EQ(cycles.size(), 4U);
  const auto& contacts = walks[0].contacts;
  const auto first = std::find_if(contacts.begin(), contacts.end(),
                                  [](const Contact& c) { return c.foot == Foot::right; }) -
                     contacts.begin();
  for (std::size_t i = 0; i < cycles.size(); ++i)
    for (const int half : {0, 1}) {
      const int frame = contacts[static_cast<std::size_t>(first) + 2 * i + half].frame;
      std::vector<double> wanted(3 * joints.size());
      pose_vector<double>(poses.pose(frame), body.references, joints, wanted);
      for (std::size_t k = 0; k < wanted.size(); ++k)
        EXPECT_NEAR(cycles[i].values[static_cast<Eigen::Index>(half * 20 * wanted.size() + k)],
                    wanted[k], 1e-12);
    }
}

TEST(Cycles, last_from_one_right_contact_to_the_next_and_say_how_fast_they_were) {
  const std::vector<Walk> walks{built_in("sad", 2, 5)};
  const std::vector<CapturedCycle> cycles = cut_cycles(walks, body_of(walks), 40);
  std::vector<int> right;
  for (const Contact& contact : walks[0].contacts)
    if (contact.foot == Foot::right) right.push_back(contact.frame);
  ASSERT_EQ(cycles.size() + 1, right.size());
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    EXPECT_EQ(cycles[i].place, static_cast<int>(i));
    EXPECT_NEAR(cycles[i].duration, (right[i + 1] - right[i]) / 30.0, 1e-12);
    EXPECT_NEAR(cycles[i].speed, 0.7, 0.1);
    EXPECT_NEAR(cycles[i].leg_length, corpus_leg_length, 0.05);
  }
}

// The same motion sampled twice as often: contacts move by up to a frame of the slower.
TEST(Cycles, are_alike_at_any_frame_rate) {
  const std::vector<Walk> slow{built_in("proud", 1, 4)}, fast{built_in("proud", 1, 4, 120)};
  const Body body = body_of(slow);
  const auto a = cut_cycles(slow, body, 40), b = cut_cycles(fast, body, 40);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].duration, b[i].duration, 1.0 / 30);
    // A frame's movement of the fastest joint is some 0.2 rad.
    EXPECT_LT((a[i].values - b[i].values).cwiseAbs().maxCoeff(), 0.2);
    EXPECT_LT(std::sqrt((a[i].values - b[i].values).squaredNorm() / 2160), 0.02);
  }
}

// The walk bent into a circle from its third cycle on.
TEST(Cycles, of_a_walk_that_turns_are_told_from_straight_ones) {
  Walk walk = built_in("proud", 1, 6);
  const int root = 0, begin = walk.clip.frames() / 2;
  Eigen::Vector3d place = walk.clip.translation(begin)[root], before = place;
  for (int frame = begin; frame < walk.clip.frames(); ++frame) {
    const double angle = 0.04 * (frame - begin);
    const Eigen::Quaterniond turn = about_vertical(angle);
    const Eigen::Vector3d now = walk.clip.translation(frame)[root];
    Eigen::Vector3d moved = turn * (now - before);
    before = now;
    place += moved;
    walk.clip.translation(frame)[root] = place;
    walk.clip.pose(frame)[root] = turn * walk.clip.pose(frame)[root];
  }
  const std::vector<Walk> walks{walk};
  const auto cycles = cut_cycles(walks, body_of(walks), 40);
  ASSERT_EQ(cycles.size(), 6U);
  EXPECT_TRUE(cycles[0].straight);
  EXPECT_TRUE(cycles[1].straight);
  EXPECT_FALSE(cycles[4].straight);
  EXPECT_FALSE(cycles[5].straight);
}

TEST(Cycles, need_an_even_number_of_frames) {
  const std::vector<Walk> walks{built_in("proud", 1, 4)};
  const Body body = body_of(walks);
  EXPECT_THROW(cut_cycles(walks, body, 39), Error);
  EXPECT_THROW(cut_cycles(walks, body, 0), Error);
}

}  // namespace
}  // namespace gait
