#include "gait/play/body/root_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "gait/error.h"

namespace gait {
namespace {

using Pose = std::vector<Eigen::Quaternionf>;

double horizontal(Eigen::Vector3d v) {
  v.y() = 0;
  return v.norm();
}

// A body of two legs with thighs and shanks of 0.4 m; the foot's ankle is 0.1 m high and its toe
// base 0.15 m ahead of it.
struct TwoLegs {
  Skeleton skeleton;
  JointRoles roles;

  TwoLegs() {
    skeleton.joints = {{"hips", -1, {0, 0, 0}, {}}};
    for (const double side : {-0.1, 0.1}) {
      const int thigh = skeleton.size();
      skeleton.joints.push_back({"thigh", 0, {side, 0, 0}, {}});
      skeleton.joints.push_back({"shank", thigh, {0, -0.4, 0}, {}});
      skeleton.joints.push_back({"foot", thigh + 1, {0, -0.4, 0}, {}});
      skeleton.joints.push_back({"toes", thigh + 2, {0, -0.1, 0.15}, {}});
    }
    roles.hips = 0;
    roles.right = {1, 2, 3, 4};
    roles.left = {5, 6, 7, 8};
  }
  Pose standing() const { return Pose(skeleton.joints.size(), Eigen::Quaternionf::Identity()); }
};

Eigen::Quaternionf pitch(double angle) {  // positive: what hangs down swings back
  return Eigen::Quaternionf(Eigen::AngleAxisf(static_cast<float>(angle), Eigen::Vector3f::UnitX()));
}

// Sets a leg: thigh pitched, knee bent by `knee` (shank back), foot pitched in the world.
void set_leg(Pose& pose, const Leg& leg, double thigh, double knee, double foot) {
  pose[leg.thigh] = pitch(thigh);
  pose[leg.shank] = pitch(knee);
  pose[leg.foot] = pitch(foot - thigh - knee);
}

TEST(RootMotion, a_stepping_body_with_flat_feet_goes_where_its_standing_leg_carries_it) {
  const TwoLegs body;
  const double rate = 60, swing = 0.35, step_seconds = 0.5;
  RootMotion root(body.skeleton, body.roles, rate);
  double standing_foot = 0.8 * std::sin(swing), worst = 0, worst_height = 0;
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  for (int step = 0; step < 12; ++step) {
    const Leg& stance = step % 2 == 0 ? body.roles.right : body.roles.left;
    const Leg& other = step % 2 == 0 ? body.roles.left : body.roles.right;
    for (int i = 0; i < step_seconds * rate; ++i) {
      const double share = i / (step_seconds * rate);
      const double angle = swing * (2 * share - 1);  // from the foot ahead to the foot behind
      const double lift = 0.7 * std::sin(M_PI * share);
      Pose pose = body.standing();
      set_leg(pose, stance, angle, 0, 0);
      set_leg(pose, other, -angle - lift / 2, lift, 0);
      const Eigen::Vector3d found = root.advance(pose).cast<double>();
      // A straight leg of 0.8 m turning about its ankle, 0.1 m above the ground.
      const Eigen::Vector3d truth(0, 0.1 + 0.8 * std::cos(angle),
                                  standing_foot + 0.8 * std::sin(angle));
      if (step == 0 && i == 0) start = truth - found;
      worst = std::max(worst, horizontal(found + start - truth));
      worst_height = std::max(worst_height, std::abs(found.y() - truth.y()));
      EXPECT_GT(root.share_of(step % 2 == 0 ? Foot::right : Foot::left),
                share > 0.2 && share < 0.95 && step > 0 ? 0.9f : -1.0f)
          << "step " << step << ", " << share;
    }
    standing_foot += 2 * 0.8 * std::sin(swing);
  }
  const double walked = 12 * 2 * 0.8 * std::sin(swing);
  EXPECT_LT(worst, 0.02 * walked);
  EXPECT_LT(worst_height, 0.01);
}

TEST(RootMotion, the_pin_rolls_from_the_flat_foot_to_the_toes_without_moving_the_root) {
  const TwoLegs body;
  const double rate = 60;
  RootMotion root(body.skeleton, body.roles, rate);
  const Eigen::Vector3d toes(0, 0, 0.15);  // the ankle stands above the origin
  double worst = 0;
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  for (int i = 0; i < 60; ++i) {
    // 0.6 s about the ankle with the sole flat, then 0.4 s about the toe base, all at 1 rad/s.
    const double angle = -0.4 + i / rate;
    const double flat = std::min(angle, 0.2), rolled = angle - flat;
    Pose pose = body.standing();
    set_leg(pose, body.roles.right, angle, 0, rolled);
    set_leg(pose, body.roles.left, -1.2, 0.6, 0);  // held up in front
    const Eigen::Vector3d found = root.advance(pose).cast<double>();
    const Eigen::Vector3d upright(0, 0.1 + 0.8 * std::cos(flat), 0.8 * std::sin(flat));
    const Eigen::Vector3d truth =
        toes + Eigen::AngleAxisd(rolled, Eigen::Vector3d::UnitX()) * (upright - toes);
    if (i == 0) start = truth - found;
    worst = std::max(worst, (found + start - truth).norm());
  }
  EXPECT_LT(worst, 0.01);  // of 0.9 m travelled
}

TEST(RootMotion, who_stands_stays_where_they_are) {
  const TwoLegs body;
  RootMotion root(body.skeleton, body.roles, 30);
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.002);  // a sensor's tenth of a degree
  Eigen::Vector3f begin;
  for (int frame = 0; frame < 30 * 60; ++frame) {
    Pose pose = body.standing();
    // Weight shifts slowly from side to side; all joints shake.
    const double sway = 0.03 * std::sin(2 * M_PI * 0.3 * frame / 30);
    const auto roll = Eigen::AngleAxisf(static_cast<float>(sway), Eigen::Vector3f::UnitZ());
    for (const Leg* leg : {&body.roles.left, &body.roles.right}) {
      pose[leg->thigh] = roll;
      pose[leg->foot] = roll.inverse();
    }
    for (auto& rotation : pose) rotation = rotation * pitch(noise(random));
    const Eigen::Vector3f place = root.advance(pose);
    if (frame == 0) begin = place;
    ASSERT_LT(horizontal((place - begin).cast<double>()), 0.05) << "after " << frame / 30.0 << " s";
    ASSERT_NEAR(place.y(), 0.9f, 0.01f);
  }
}

TEST(RootMotion, starts_anew_where_it_is_put) {
  const TwoLegs body;
  RootMotion root(body.skeleton, body.roles, 30);
  Pose pose = body.standing();
  root.advance(pose);
  set_leg(pose, body.roles.right, 0.3, 0, 0);
  root.advance(pose);
  root.reset({3, 7, -2});
  const Eigen::Vector3f place = root.advance(body.standing());
  EXPECT_LT((place - Eigen::Vector3f(3, 0.9f, -2)).norm(), 1e-6f);
  EXPECT_EQ(root.velocity(), Eigen::Vector3f::Zero());
}

TEST(RootMotion, a_broken_pose_leaves_it_where_it_is_and_the_walk_goes_on) {
  const TwoLegs body;
  RootMotion root(body.skeleton, body.roles, 30);
  const Eigen::Vector3f before = root.advance(body.standing());
  Pose broken = body.standing();
  broken[body.roles.left.foot].w() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(root.advance(broken), before);
  EXPECT_EQ(root.advance(std::span(broken).first(3)), before);
  EXPECT_EQ(root.advance(body.standing(), std::numeric_limits<float>::infinity()), before);
  EXPECT_LT((root.advance(body.standing()) - before).norm(), 1e-6f);
}

TEST(RootMotion, a_body_without_legs_or_a_rate_that_is_none_is_an_error) {
  const TwoLegs body;
  JointRoles roles = body.roles;
  roles.left.foot = -1;
  EXPECT_THROW(RootMotion(body.skeleton, roles, 30), Error);
  EXPECT_THROW(RootMotion(body.skeleton, body.roles, 0), Error);
  EXPECT_THROW(RootMotion(body.skeleton, body.roles, std::nan("")), Error);
  Skeleton apart = body.skeleton;
  apart.joints[body.roles.left.thigh].parent = -1;
  EXPECT_THROW(RootMotion(apart, body.roles, 30), Error);
}

}  // namespace
}  // namespace gait
