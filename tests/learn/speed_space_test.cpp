#include "gait/learn/speed_space.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gait/error.h"
#include "gait/learn/standing_pose.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"
#include "motion/walked_ways.h"
#include "play/cycles/walks_over_speed.h"

namespace gait {
namespace {

using testing::short_leg;
using testing::tall_leg;

double mean_angle(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double sum = 0;
  for (Eigen::Index i = 0; i < a.size(); i += 3)
    sum += angle_between(exponential_map<double>(Eigen::Vector3d(a.segment<3>(i))),
                         exponential_map<double>(Eigen::Vector3d(b.segment<3>(i))));
  return sum / static_cast<double>(a.size() / 3) * 180 / std::numbers::pi;
}

Eigen::VectorXd cycle_at(const SpeedSpace& space, double v) {
  return space.space.mean + space.space.components * (space.intercept + v * space.slope);
}

Eigen::VectorXd mean_cycle(const std::vector<CapturedCycle>& cycles) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(cycles.front().values.size());
  for (const CapturedCycle& cycle : cycles) sum += cycle.values;
  return sum / static_cast<double>(cycles.size());
}

struct Learnt {
  std::vector<Walk> walks = testing::walks_over_speed();
  Body body = body_of_subjects(walks);
  std::vector<SubjectCycles> subjects = cycles_of_subjects(walks, body);
  SpeedSpaces spaces = learn_speed_spaces(subjects, body);
};

const Learnt& learnt() {
  static const Learnt all;
  return all;
}

TEST(SpeedSpace, every_subject_is_learnt_on_his_own_legs) {
  ASSERT_EQ(learnt().spaces.subjects.size(), 2u);
  const SpeedSpace& small = learnt().spaces.subjects[0];
  const SpeedSpace& tall = learnt().spaces.subjects[1];
  EXPECT_EQ(small.subject, "short");
  EXPECT_EQ(tall.subject, "tall");
  EXPECT_NEAR(small.leg_length, short_leg, 1e-6);
  EXPECT_NEAR(tall.leg_length, tall_leg, 1e-6);
  EXPECT_NEAR(tall.slowest, 1.1, 0.08);
  EXPECT_NEAR(tall.fastest, 2.0, 0.08);
  EXPECT_GE(tall.cycles, 12);
}

TEST(SpeedSpace, a_speed_never_walked_is_foretold_between_those_that_were) {
  const Walk unseen = testing::walk_at(1.55, tall_leg, "tall", 5);
  const auto truth = cycles_of_subjects({unseen}, learnt().body);
  const double v = 1.55;
  const Eigen::VectorXd captured = mean_cycle(truth.front().cycles);
  const SpeedSpace& tall = learnt().spaces.subjects[1];
  const double error = mean_angle(cycle_at(tall, v), captured);
  EXPECT_LT(error, 2.5);
  // Speed is followed: the slowest and the fastest cycle are worse guesses.
  EXPECT_LT(error, mean_angle(cycle_at(tall, tall.slowest), captured));
  EXPECT_LT(error, mean_angle(cycle_at(tall, tall.fastest), captured));
}

TEST(SpeedSpace, lines_are_least_squares_when_held_to_nobody) {
  SpeedOptions options;
  options.held_to_shared_slope = 0;
  const SpeedSpace space =
      learn_speed_spaces(learnt().subjects, learnt().body, options).subjects[1];
  const auto& cycles = learnt().subjects[1].cycles;
  const auto count = static_cast<Eigen::Index>(cycles.size());
  Eigen::MatrixXd basis(count, 2), scores(count, space.space.kept());
  for (Eigen::Index i = 0; i < count; ++i) {
    basis.row(i) << 1, cycles[i].speed / tall_leg;
    scores.row(i) =
        (space.space.components.transpose() * (cycles[i].values - space.space.mean)).transpose();
  }
  const Eigen::MatrixXd lines = basis.colPivHouseholderQr().solve(scores);  // another way than ours
  const double size = scores.cwiseAbs().maxCoeff();
  EXPECT_LT((lines.row(0).transpose() - space.intercept).norm(), 1e-8 * size);
  EXPECT_LT((lines.row(1).transpose() - space.slope).norm(), 1e-8 * size);
}

TEST(SpeedSpace, who_walked_at_one_speed_changes_with_speed_as_the_others_do) {
  std::vector<SubjectCycles> subjects = learnt().subjects;
  auto& cycles = subjects[0].cycles;
  const double speed = cycles.front().speed;
  std::erase_if(cycles, [&](const auto& cycle) { return std::abs(cycle.speed - speed) > 0.02; });
  ASSERT_GE(cycles.size(), 2u);
  SpeedOptions options;
  options.held_to_shared_slope = 100;
  const SpeedSpaces spaces = learn_speed_spaces(subjects, learnt().body, options);
  const Eigen::VectorXd taken = spaces.subjects[0].space.components * spaces.subjects[0].slope;
  const Eigen::VectorXd own =
      learnt().spaces.subjects[1].space.components * learnt().spaces.subjects[1].slope;
  EXPECT_GT(taken.normalized().dot(own.normalized()), 0.9);
}

TEST(SpeedSpace, one_space_holds_all_subjects) {
  ASSERT_TRUE(learnt().spaces.shared);
  const CycleSpace& shared = *learnt().spaces.shared;
  for (const SpeedSpace& subject : learnt().spaces.subjects) {
    const Eigen::VectorXd cycle =
        shared.mean + shared.components * (subject.shared.intercept + 1.5 * subject.shared.slope);
    EXPECT_LT(mean_angle(cycle, cycle_at(subject, 1.5)), 1.0) << subject.subject;
  }
}

TEST(SpeedSpace, a_walk_ends_where_its_cycle_began) {
  const SpeedSpace& tall = learnt().spaces.subjects[1];
  const Eigen::VectorXd cycle = cycle_at(tall, 1.5);
  const Eigen::Index size = cycle.size() / tall.space.frames;
  double largest = 0;
  for (int k = 1; k < tall.space.frames; ++k)
    largest = std::max(
        largest, (cycle.segment(k * size, size) - cycle.segment((k - 1) * size, size)).norm());
  EXPECT_LT((cycle.head(size) - cycle.tail(size)).norm(), largest);
}

TEST(SpeedSpace, standing_is_even_and_flat) {
  const Body& body = learnt().body;
  const JointRoles roles = body_roles(body);
  const SpeedSpace& tall = learnt().spaces.subjects[1];
  const Eigen::VectorXd values = tall.space.mean + tall.space.components * tall.standing;
  std::vector<Eigen::Quaterniond> pose = body.references;
  for (std::size_t i = 0; i < tall.space.joints.size(); ++i)
    pose[tall.space.joints[i]] =
        rotation_from<double>(std::span<const double, 3>(values.data() + 3 * i, 3),
                              body.references[tall.space.joints[i]]);
  Clip clip = body_clip(body, "standing", 60, 1);
  place_body(clip, 0, roles, pose, 0, Eigen::Vector3d::Zero());
  const WorldPoses world = world_poses(clip);
  const auto& right = world.positions[roles.right.foot];
  const auto& left = world.positions[roles.left.foot];
  EXPECT_NEAR(right.y(), left.y(), 0.005);
  EXPECT_NEAR(right.z(), left.z(), 0.005);
  EXPECT_GT(left.x() - right.x(), 0.08);
  EXPECT_NEAR(left.x() + right.x(), 0, 0.02);
  for (const Leg* leg : {&roles.right, &roles.left}) {
    std::vector<double> heights;  // of heel and ball
    for (const Eigen::Vector3d& tip : body.skeleton.joints[leg->foot].tips)
      heights.push_back((world.positions[leg->foot] + world.rotations[leg->foot] * tip).y());
    ASSERT_EQ(heights.size(), 2u);
    EXPECT_NEAR(heights[0], heights[1], 0.02);
  }
  // All frames of standing are the same.
  const Eigen::Index size = values.size() / tall.space.frames;
  EXPECT_LT((values.head(size) - values.tail(size)).norm(), 1e-9);
}

TEST(SpeedSpace, a_clip_named_standing_is_how_he_stands) {
  std::vector<Walk> walks = testing::walks_over_speed();
  Walk still = walks.front();
  still.clip.name = "tall_Standing.bvh";
  for (int frame = 0; frame < still.clip.frames(); ++frame) {
    std::copy(walks.front().clip.pose(7).begin(), walks.front().clip.pose(7).end(),
              still.clip.pose(frame).begin());
    std::copy(walks.front().clip.translation(7).begin(), walks.front().clip.translation(7).end(),
              still.clip.translation(frame).begin());
  }
  walks.push_back(still);
  const auto subjects = cycles_of_subjects(walks, learnt().body);
  EXPECT_EQ(subjects[0].standing.size(), 0);
  ASSERT_GT(subjects[1].standing.size(), 0);
  EXPECT_EQ(subjects[1].cycles.size(), learnt().subjects[1].cycles.size());
  const SpeedSpace tall = learn_speed_spaces(subjects, learnt().body).subjects[1];
  const Eigen::VectorXd values = tall.space.mean + tall.space.components * tall.standing;
  EXPECT_LT((values.head(subjects[1].standing.size()) - subjects[1].standing).norm(), 1e-6);
}

TEST(SpeedSpace, the_frequency_law_is_the_one_they_walked_by) {
  // The corpus steps 1.03 times as often as 0.7516 V^0.4077.
  EXPECT_NEAR(learnt().spaces.law.scale, 1.03 * 0.7516, 0.02);
  EXPECT_NEAR(learnt().spaces.law.power, 0.4077, 0.04);
}

TEST(SpeedSpace, one_subject_needs_no_shared_space) {
  std::vector<SubjectCycles> one{learnt().subjects[0]};
  const SpeedSpaces spaces = learn_speed_spaces(one, learnt().body);
  EXPECT_FALSE(spaces.shared);
  EXPECT_EQ(spaces.subjects.front().shared.intercept.size(), 0);
  EXPECT_TRUE(spaces.subjects.front().intercept.allFinite());
}

TEST(SpeedSpace, walks_at_one_speed_alone_still_slow_down_towards_standing) {
  std::vector<SubjectCycles> one{learnt().subjects[0]};
  one[0].cycles.resize(2);
  one[0].cycles[1] = one[0].cycles[0];
  const SpeedSpaces spaces = learn_speed_spaces(one, learnt().body);
  EXPECT_TRUE(spaces.subjects.front().slope.allFinite());
  EXPECT_GT(spaces.subjects.front().slope.norm(), 0.1);
  EXPECT_EQ(spaces.law.power, 0.5);  // Inman's
}

// The walk as programs write it that put a joint above the hips, and the hips where they began.
Walk below_another_joint(Walk walk, const Eigen::Vector3d& hips) {
  Clip& clip = walk.clip;
  const Clip alone = clip;
  for (Joint& joint : clip.skeleton.joints) ++joint.parent;
  clip.skeleton.joints.front().offset = hips;
  clip.skeleton.joints.insert(clip.skeleton.joints.begin(), {"World", -1, {0, 0, 0}, {}});
  clip.resize(alone.frames());
  for (int frame = 0; frame < alone.frames(); ++frame) {
    std::ranges::copy(alone.pose(frame), clip.pose(frame).begin() + 1);
    std::ranges::copy(alone.translation(frame), clip.translation(frame).begin() + 1);
  }
  return walk;
}

TEST(SpeedSpace, where_the_hips_lie_in_the_file_is_no_bone) {
  std::vector<Walk> walks;
  for (const Walk& walk : learnt().walks)
    walks.push_back(below_another_joint(
        walk, walks.size() % 2 == 0 ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(-1, 0, 0)));
  const auto subjects = cycles_of_subjects(walks, body_of_subjects(walks));
  ASSERT_EQ(subjects.size(), learnt().subjects.size());
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    ASSERT_EQ(subjects[i].cycles.size(), learnt().subjects[i].cycles.size());
    EXPECT_LT((subjects[i].cycles[0].values - learnt().subjects[i].cycles[0].values).norm(), 1e-6);
  }
}

TEST(SpeedSpace, joints_between_hip_and_ankle_change_no_leg_and_no_speed) {
  std::vector<Walk> walks = learnt().walks;
  for (Walk& walk : walks) walk.clip = testing::with_joints_in_legs(walk.clip);
  const Body body = body_of_subjects(walks);
  const auto subjects = cycles_of_subjects(walks, body);
  const SpeedSpaces spaces = learn_speed_spaces(subjects, body);
  ASSERT_EQ(subjects.size(), learnt().subjects.size());
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    EXPECT_NEAR(subjects[i].leg_length, learnt().subjects[i].leg_length, 1e-9);
    ASSERT_EQ(subjects[i].cycles.size(), learnt().subjects[i].cycles.size());
    for (std::size_t k = 0; k < subjects[i].cycles.size(); ++k)
      EXPECT_NEAR(subjects[i].cycles[k].leg_length, learnt().subjects[i].cycles[k].leg_length,
                  1e-9);
    EXPECT_NEAR(spaces.subjects[i].slowest, learnt().spaces.subjects[i].slowest, 1e-6);
    EXPECT_NEAR(spaces.subjects[i].fastest, learnt().spaces.subjects[i].fastest, 1e-6);
  }
  EXPECT_NEAR(spaces.law.scale, learnt().spaces.law.scale, 1e-6);
  EXPECT_NEAR(spaces.law.power, learnt().spaces.law.power, 1e-6);
}

TEST(SpeedSpace, what_cannot_be_learnt_from_is_said) {
  EXPECT_THROW(learn_speed_spaces({}, learnt().body), Error);
  EXPECT_THROW(body_of_subjects({}), Error);
  std::vector<Walk> other = {learnt().walks.front()};
  Joint& shank = other[0].clip.skeleton.joints[find_roles(other[0].clip.skeleton).left.shank];
  shank.offset = Eigen::Vector3d(shank.offset.norm(), 0, 0);
  try {
    cycles_of_subjects(other, learnt().body);
    FAIL() << "a leg that rests sideways was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(shank.name), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace gait
