// Contacts found in the motion, against the built-in walks' exact ones.
#include "gait/motion/contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gait/error.h"
#include "motion/walked_ways.h"

namespace gait {
namespace {

using testing::around;
using testing::backwards;
using testing::on_treadmill;
using testing::turned;
using testing::walk_in;
using testing::with_joints_in_legs;

WalkTrack follow(const Clip& clip) { return follow_walk(clip, find_roles(clip.skeleton)); }

double true_speed(const CorpusWalk& walk) {
  const int begin = walk.contacts.front().frame, end = walk.contacts.back().frame;
  return (walk.clip.translation(end)[0] - walk.clip.translation(begin)[0]).norm() *
         walk.clip.frame_rate / (end - begin);
}

TEST(Contacts, of_every_walk_of_the_corpus_are_within_one_frame) {
  int contacts = 0, exact = 0;
  for (const CorpusWalk& walk : make_corpus()) {
    const WalkTrack track = follow(walk.clip);
    ASSERT_EQ(track.contacts.size(), walk.contacts.size()) << walk.clip.name;
    for (std::size_t i = 0; i < walk.contacts.size(); ++i) {
      EXPECT_EQ(track.contacts[i].foot, walk.contacts[i].foot) << walk.clip.name;
      EXPECT_LE(std::abs(track.contacts[i].frame - walk.contacts[i].frame), 1)
          << walk.clip.name << " contact " << i;
      ++contacts;
      exact += track.contacts[i].frame == walk.contacts[i].frame;
    }
  }
  RecordProperty("contacts", contacts);
  RecordProperty("exact", exact);
}

TEST(Contacts, are_found_whichever_way_the_walk_goes_and_at_other_rates) {
  const CorpusWalk walk = walk_in("cool");
  const WalkTrack ahead = follow(walk.clip);
  for (const double angle : {-2.5, -1.0, 0.7, 3.1}) {
    const std::vector<Contact> other_way = follow(turned(walk.clip, angle)).contacts;
    ASSERT_EQ(other_way, ahead.contacts);
    for (std::size_t i = 0; i < other_way.size(); ++i)
      EXPECT_NEAR(other_way[i].offset, ahead.contacts[i].offset, 1e-6);
  }
  WalkPlan plan;
  plan.style = corpus_style("cool");
  plan.cycles = 6;
  const CorpusWalk fast = make_walk(plan, 120);
  const WalkTrack track = follow(fast.clip);
  ASSERT_EQ(track.contacts.size(), fast.contacts.size());
  for (std::size_t i = 0; i < fast.contacts.size(); ++i)
    EXPECT_LE(std::abs(track.contacts[i].frame - fast.contacts[i].frame), 4) << "a thirtieth";
}

TEST(Contacts, lie_between_frames_where_another_rate_sees_them) {
  WalkPlan plan;
  plan.cycles = 6;
  for (const char* style : {"cool", "sad", "in-a-hurry"}) {
    plan.style = corpus_style(style);
    const std::vector<Contact> coarse = follow(make_walk(plan, 30).clip).contacts;
    const std::vector<Contact> fine = follow(make_walk(plan, 240).clip).contacts;
    ASSERT_EQ(coarse.size(), fine.size());
    for (std::size_t i = 0; i < fine.size(); ++i) {
      EXPECT_LE(std::abs(coarse[i].offset), 0.5);
      EXPECT_NEAR(coarse[i].seconds(30), fine[i].seconds(240), 0.012) << style << ' ' << i;
    }
  }
}

TEST(WalkTrack, knows_cycle_speed_and_leg) {
  for (const WalkStyle& style : corpus_styles()) {
    const CorpusWalk walk = walk_in(style.name);
    const WalkTrack track = follow(walk.clip);
    const double speed = true_speed(walk);
    EXPECT_FALSE(track.treadmill) << style.name;
    EXPECT_NEAR(track.speed / speed, 1, 0.05) << style.name;
    const double cycle = (walk.contacts.back().frame - walk.contacts.front().frame) / 30.0 /
                         (static_cast<double>(walk.contacts.size() - 1) / 2);
    EXPECT_NEAR(track.cycle_seconds, cycle, 0.1) << style.name;
    EXPECT_NEAR(track.leg_length, corpus_leg_length, 0.01);
  }
}

TEST(WalkTrack, on_a_treadmill_has_the_speed_of_the_belt) {
  for (const WalkStyle& style : corpus_styles()) {
    const CorpusWalk walk = walk_in(style.name);
    const WalkTrack track = follow(on_treadmill(walk.clip));
    EXPECT_TRUE(track.treadmill) << style.name;
    EXPECT_NEAR(track.speed / true_speed(walk), 1, 0.05) << style.name;
    ASSERT_EQ(track.contacts.size(), walk.contacts.size()) << style.name;
    for (std::size_t i = 0; i < walk.contacts.size(); ++i)
      EXPECT_LE(std::abs(track.contacts[i].frame - walk.contacts[i].frame), 1) << style.name;
  }
}

TEST(WalkTrack, backwards_is_no_treadmill_and_as_fast) {
  for (const char* style : {"proud", "afraid", "in-a-hurry"}) {
    const CorpusWalk walk = walk_in(style);
    const WalkTrack track = follow(backwards(walk.clip));
    EXPECT_FALSE(track.treadmill) << style;
    EXPECT_NEAR(track.speed / true_speed(walk), 1, 0.05) << style;
  }
}

TEST(StraightCycles, of_a_straight_walk_are_all_and_of_a_circle_none) {
  const CorpusWalk walk = walk_in("proud", 8);
  EXPECT_EQ(straight_cycles(follow(walk.clip)).size(), 8u);
  const WalkTrack circle = follow(around(walk.clip, 1.5));
  EXPECT_GE(cycles_between(circle.contacts).size(), 7u) << "they are cycles all the same";
  EXPECT_TRUE(straight_cycles(circle).empty());
  // With a wider limit they count.
  EXPECT_GE(straight_cycles(circle, 3).size(), 7u);
}

TEST(WalkTrack, of_who_does_not_walk_has_no_contacts) {
  CorpusWalk walk = walk_in("proud", 3);
  Clip still = walk.clip;
  for (int frame = 1; frame < still.frames(); ++frame) {
    std::copy(still.pose(0).begin(), still.pose(0).end(), still.pose(frame).begin());
    still.translation(frame)[0] = still.translation(0)[0];
  }
  const WalkTrack track = follow(still);
  EXPECT_TRUE(track.contacts.empty());
  EXPECT_NEAR(track.speed, 0, 1e-9);
  EXPECT_FALSE(track.treadmill);
  for (const int frames : {0, 1, 2}) {
    Clip brief = walk.clip;
    brief.resize(frames);
    const WalkTrack none = follow(brief);
    EXPECT_TRUE(none.contacts.empty());
    EXPECT_EQ(static_cast<int>(none.heading.size()), frames);
  }
}

TEST(WalkTrack, needs_legs) {
  const CorpusWalk walk = walk_in("proud", 1);
  JointRoles roles = find_roles(walk.clip.skeleton);
  roles.left.foot = -1;
  EXPECT_THROW(follow_walk(walk.clip, roles), Error);
}

TEST(Contacts, legs_are_as_long_whatever_joints_lie_between_hip_and_ankle) {
  const CorpusWalk walk = walk_in("neutral");
  const Clip split = with_joints_in_legs(walk.clip);
  const JointRoles roles = find_roles(split.skeleton);
  EXPECT_NE(split.skeleton.joints[roles.left.shank].parent, roles.left.thigh);
  EXPECT_NE(split.skeleton.joints[roles.left.foot].parent, roles.left.shank);
  EXPECT_NEAR(leg_length(split.skeleton, roles), corpus_leg_length, 1e-9);
  const WalkTrack plain = follow(walk.clip), track = follow(split);
  EXPECT_NEAR(track.leg_length, plain.leg_length, 1e-9);
  EXPECT_EQ(track.contacts, plain.contacts);
  EXPECT_NEAR(track.speed, plain.speed, 1e-9);
}

}  // namespace
}  // namespace gait
