// Feet that stay where they stand, seen from outside: by foot_slide and by the kinematics of clips.
#include "gait/play/body/foot_lock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gait/corpus/corpus.h"
#include "gait/judge/foot_slide.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"
#include "play/few_walks.h"
#include "play/forbidden_memory.h"

namespace gait {
namespace {

using testing::ForbiddenMemory;
using testing::plan_of;

using Pose = std::vector<Eigen::Quaternionf>;

Eigen::Quaternionf pitch(double angle) {  // positive: what hangs down swings back
  return Eigen::Quaternionf(Eigen::AngleAxisf(static_cast<float>(angle), Eigen::Vector3f::UnitX()));
}

// A built-in walk, whose feet stand still, with thighs that are `amplitude` (rad) off, slowly back
// and forth and each for itself: at an ankle some 9 mm for 0.01.
struct Spoilt {
  CorpusWalk walk;
  JointRoles roles;
  double amplitude;

  explicit Spoilt(double off, const std::string& style = "proud")
      : walk(make_walk(plan_of(style, 3, 12))),
        roles(find_roles(walk.clip.skeleton)),
        amplitude(off) {}

  int frames() const { return walk.clip.frames(); }
  double rate() const { return walk.clip.frame_rate; }
  Pose pose(int frame) const {
    Pose pose;
    for (const auto& rotation : walk.clip.pose(frame)) pose.push_back(rotation.cast<float>());
    const double time = frame / rate();
    pose[roles.right.thigh] =
        pose[roles.right.thigh] * pitch(amplitude * std::sin(2 * M_PI * 0.7 * time));
    pose[roles.left.thigh] =
        pose[roles.left.thigh] * pitch(amplitude * std::sin(2 * M_PI * 0.9 * time + 1));
    return pose;
  }
};

void put(Clip& clip, int frame, const Pose& pose, const Eigen::Vector3f& hips, int hips_joint) {
  for (std::size_t joint = 0; joint < pose.size(); ++joint)
    clip.pose(frame)[joint] = pose[joint].cast<double>();
  clip.translation(frame)[hips_joint] = hips.cast<double>();
}

struct Walked {
  Clip plain, locked;                        // the same root for both
  std::vector<Eigen::Vector3f> right, left;  // corrections
  std::vector<bool> right_held, left_held;
};

Walked walked(const Spoilt& spoilt, double strength = 1) {
  const Skeleton& skeleton = spoilt.walk.clip.skeleton;
  Walked result{spoilt.walk.clip, spoilt.walk.clip, {}, {}, {}, {}};
  RootMotion root(skeleton, spoilt.roles, spoilt.rate());
  root.set_gentle(1);
  FootLock lock(skeleton, spoilt.roles, spoilt.rate());
  for (int frame = 0; frame < spoilt.frames(); ++frame) {
    Pose pose = spoilt.pose(frame);
    const Eigen::Vector3f hips = root.advance(pose);
    put(result.plain, frame, pose, hips, spoilt.roles.hips);
    lock.apply(pose, root, 0, static_cast<float>(strength));
    put(result.locked, frame, pose, hips, spoilt.roles.hips);
    result.right.push_back(lock.correction(Foot::right));
    result.left.push_back(lock.correction(Foot::left));
    result.right_held.push_back(lock.hold(Foot::right) > 0.5f);
    result.left_held.push_back(lock.hold(Foot::left) > 0.5f);
  }
  return result;
}

TEST(FootLock, makes_a_spoilt_walk_stand_nearly_as_it_was_captured) {
  for (const char* style : {"proud", "tiptoeing", "in-a-hurry", "heavy"}) {
    const Spoilt spoilt(0.02, style);
    RootMotion root(spoilt.walk.clip.skeleton, spoilt.roles, spoilt.rate());
    Clip alone = spoilt.walk.clip;
    for (int frame = 0; frame < spoilt.frames(); ++frame) {
      const Pose pose = spoilt.pose(frame);
      put(alone, frame, pose, root.advance(pose), spoilt.roles.hips);
    }
    // From the third contact on: the root has found its way.
    const std::vector<Contact> contacts(spoilt.walk.contacts.begin() + 2,
                                        spoilt.walk.contacts.end());
    const double before = foot_slide(alone, spoilt.roles, contacts).mean,
                 after = foot_slide(walked(spoilt).locked, spoilt.roles, contacts).mean;
    std::printf("%s: %.2f mm a stance, %.2f mm with feet locked\n", style, before, after);
    EXPECT_GT(before, 1.5) << style;
    EXPECT_LT(after, 1) << style;
  }
}

TEST(FootLock, turns_only_legs_keeps_soles_as_they_are_and_puts_ankles_where_it_says) {
  const Spoilt spoilt(0.02);
  const Walked result = walked(spoilt);
  const WorldPoses plain = world_poses(result.plain), locked = world_poses(result.locked);
  const std::size_t joints = result.plain.skeleton.joints.size();
  double off = 0, largest = 0;
  for (int frame = 0; frame < spoilt.frames(); ++frame) {
    const std::size_t at = static_cast<std::size_t>(frame) * joints;
    for (const Leg* leg : {&spoilt.roles.right, &spoilt.roles.left}) {
      const auto foot = at + static_cast<std::size_t>(leg->foot);
      EXPECT_LT(angle_between(plain.rotations[foot], locked.rotations[foot]), 1e-3);
      const Eigen::Vector3d wanted =
          (leg == &spoilt.roles.right ? result.right : result.left)[static_cast<std::size_t>(frame)]
              .cast<double>();
      const Eigen::Vector3d moved = locked.positions[foot] - plain.positions[foot];
      const double missed = std::hypot(moved.x() - wanted.x(), moved.z() - wanted.z());
      // In the air a knee that is fast already is not made faster: the foot comes after.
      const bool held =
          (leg == &spoilt.roles.right ? result.right_held
                                      : result.left_held)[static_cast<std::size_t>(frame)];
      off = std::max(off, held ? missed : 0.0);
      largest = std::max(largest, wanted.norm());
      EXPECT_LT(missed, 0.008) << "frame " << frame;
      EXPECT_GT(moved.y(), held ? -1e-3 : -0.012) << "frame " << frame;
      EXPECT_LT(moved.y(), 0.5 * wanted.norm() + 1e-3) << "frame " << frame;
    }
    for (int joint = 0; joint < spoilt.walk.clip.skeleton.size(); ++joint) {
      if (spoilt.roles.in_leg[static_cast<std::size_t>(joint)]) continue;
      EXPECT_EQ(result.plain.pose(frame)[joint].coeffs(),
                result.locked.pose(frame)[joint].coeffs());
    }
  }
  EXPECT_GT(largest, 0.01);
  EXPECT_LT(off, 0.0015);
}

// Above 0: the way knees bend.
double knee(const Clip& clip, const WorldPoses& world, const JointRoles& roles, const Leg& leg,
            int frame) {
  const auto place = [&](int joint) {
    return world.positions[static_cast<std::size_t>(frame) * clip.skeleton.joints.size() +
                           static_cast<std::size_t>(joint)];
  };
  const Eigen::Vector3d upper = place(leg.shank) - place(leg.thigh),
                        lower = place(leg.foot) - place(leg.shank), axis = upper.cross(lower);
  return std::copysign(std::atan2(axis.norm(), upper.dot(lower)),
                       axis.dot(place(roles.left.thigh) - place(roles.right.thigh)));
}

// Who straightens crouched legs within a tenth of a second throws the hips up faster than a gentle
// root follows.
TEST(FootLock, lifts_feet_that_a_gentle_root_lets_sink) {
  const Spoilt spoilt(0);
  const Skeleton& skeleton = spoilt.walk.clip.skeleton;
  for (const int rate : {30, 60, 120}) {
    RootMotion root(skeleton, spoilt.roles, rate);
    root.set_gentle(1);
    FootLock lock(skeleton, spoilt.roles, rate);
    double sunk = 0, deepest = 0, knees = 0;
    Clip clip = spoilt.walk.clip;
    const auto lowest_ankle = [&](const Pose& pose, const Eigen::Vector3f& hips) {
      put(clip, 0, pose, hips, spoilt.roles.hips);
      const WorldPoses world = world_poses(clip);
      return world.positions[static_cast<std::size_t>(spoilt.roles.right.foot)].y();
    };
    double ankle = 0;
    for (int frame = 0; frame < 3 * rate; ++frame) {
      const double bend = 0.7 * std::clamp((1.1 * rate - frame) / (0.1 * rate), 0.0, 1.0);
      Pose pose(skeleton.joints.size(), Eigen::Quaternionf::Identity());
      for (const Leg* leg : {&spoilt.roles.right, &spoilt.roles.left}) {
        pose[leg->thigh] = pitch(-bend);
        pose[leg->shank] = pitch(2 * bend);
        pose[leg->foot] = pitch(-bend);
      }
      const Eigen::Vector3f hips = root.advance(pose);
      const double plain = lowest_ankle(pose, hips);
      lock.apply(pose, root);
      const double lifted = lowest_ankle(pose, hips);
      if (frame == rate - 5) ankle = lifted;
      if (frame < rate) continue;
      sunk = std::min(sunk, plain - ankle), deepest = std::min(deepest, lifted - ankle);
      if (frame == 3 * rate - 1) knees = angle_between(pose[spoilt.roles.right.shank], pitch(0));
    }
    EXPECT_LT(sunk, -0.02) << rate;
    EXPECT_GT(deepest, -0.01) << rate;
    EXPECT_LT(knees, 0.02) << rate;  // straight again in the end
  }
}

TEST(FootLock, stretches_no_knee_further_than_it_was_or_than_eight_degrees) {
  for (const char* style : {"proud", "drunk", "manly"}) {
    const Spoilt spoilt(0.03, style);
    const Walked result = walked(spoilt);
    const WorldPoses plain = world_poses(result.plain), locked = world_poses(result.locked);
    for (int frame = 0; frame < spoilt.frames(); ++frame)
      for (const Leg* leg : {&spoilt.roles.right, &spoilt.roles.left}) {
        const double was = knee(result.plain, plain, spoilt.roles, *leg, frame),
                     is = knee(result.locked, locked, spoilt.roles, *leg, frame);
        EXPECT_GT(is, std::min<double>(was, FootLock::straightest) - 0.003)
            << style << ", frame " << frame;
      }
  }
}

TEST(FootLock, bends_straight_legs_gently_and_never_backward) {
  // Who stands with knees all but straight and sways.
  const Spoilt spoilt(0);
  const Skeleton& skeleton = spoilt.walk.clip.skeleton;
  for (const double bent : {0.0, 0.02, 0.1}) {
    RootMotion root(skeleton, spoilt.roles, 30);
    FootLock lock(skeleton, spoilt.roles, 30);
    double before[2] = {bent, bent}, corrected = 0;
    for (int frame = 0; frame < 300; ++frame) {
      Clip clip;
      clip.skeleton = skeleton;
      clip.resize(1);
      Pose pose(skeleton.joints.size(), Eigen::Quaternionf::Identity());
      const double sway = 0.012 * std::sin(2 * M_PI * 0.4 * frame / 30);
      for (const Leg* leg : {&spoilt.roles.right, &spoilt.roles.left}) {
        const double thigh = (leg == &spoilt.roles.right ? sway : -sway) - bent / 2;
        pose[leg->thigh] = pitch(thigh);
        pose[leg->shank] = pitch(bent);
        pose[leg->foot] = pitch(-thigh - bent);
      }
      const Eigen::Vector3f hips = root.advance(pose);
      lock.apply(pose, root);
      put(clip, 0, pose, hips, spoilt.roles.hips);
      const WorldPoses world = world_poses(clip);
      int side = 0;
      for (const Leg* leg : {&spoilt.roles.right, &spoilt.roles.left}) {
        const double bend = knee(clip, world, spoilt.roles, *leg, 0);
        EXPECT_GT(bend, -0.005);
        EXPECT_LT(std::abs(bend - before[side]), 0.06) << "frame " << frame;
        before[side++] = bend;
      }
      corrected = std::max<double>(corrected, lock.correction(Foot::right).norm());
    }
    EXPECT_GT(corrected, 0.004);
  }
}

TEST(FootLock, lets_go_of_feet_that_were_put_elsewhere) {
  const Spoilt spoilt(0.06);  // ankles go 10 cm to and fro
  const Walked result = walked(spoilt);
  float largest = 0, fastest = 0;
  for (const auto* corrections : {&result.right, &result.left})
    for (std::size_t i = 1; i < corrections->size(); ++i) {
      largest = std::max(largest, (*corrections)[i].norm());
      fastest = std::max(fastest, ((*corrections)[i] - (*corrections)[i - 1]).norm());
    }
  EXPECT_GT(largest, 0.02f);
  EXPECT_LE(largest, FootLock::farthest + 1e-6f);
  EXPECT_LT(fastest * spoilt.rate(), 1.5);  // m/s: feet in swing do 4
}

TEST(FootLock, fades_when_it_is_switched_off_and_then_leaves_poses_as_they_are) {
  const Spoilt spoilt(0.02);
  const Skeleton& skeleton = spoilt.walk.clip.skeleton;
  RootMotion root(skeleton, spoilt.roles, spoilt.rate());
  FootLock lock(skeleton, spoilt.roles, spoilt.rate());
  float before = 0;
  for (int frame = 0; frame < spoilt.frames(); ++frame) {
    const Pose came = spoilt.pose(frame);
    Pose pose = came;
    root.advance(pose);
    lock.apply(pose, root, 0, frame < 60 ? 1 : 0);
    const float now = lock.correction(Foot::right).norm() + lock.correction(Foot::left).norm();
    if (frame == 59) {
      EXPECT_GT(now, 0.003f);
    }
    if (frame >= 60) {
      EXPECT_LT(std::abs(now - before), 0.006f) << "frame " << frame;
    }
    before = now;
    if (frame < 60 + 1.5 * spoilt.rate()) continue;
    for (std::size_t joint = 0; joint < pose.size(); ++joint)
      ASSERT_EQ(pose[joint].coeffs(), came[joint].coeffs()) << "frame " << frame;
  }
}

TEST(FootLock, holds_feet_whichever_way_the_walk_goes) {
  const Spoilt spoilt(0.015);
  const Skeleton& skeleton = spoilt.walk.clip.skeleton;
  const float heading = 2.1f;
  RootMotion root(skeleton, spoilt.roles, spoilt.rate()), turned(root);
  FootLock lock(skeleton, spoilt.roles, spoilt.rate()), turned_lock(lock);
  for (int frame = 0; frame < spoilt.frames(); ++frame) {
    Pose ahead = spoilt.pose(frame), aside = ahead;
    root.advance(ahead);
    lock.apply(ahead, root);
    turned.advance(aside, heading);
    turned_lock.apply(aside, turned, heading);
    for (std::size_t joint = 0; joint < ahead.size(); ++joint)
      ASSERT_LT(angle_between(ahead[joint], aside[joint]), 0.005f)
          << "frame " << frame << ", joint " << joint;
  }
}

TEST(FootLock, leaves_broken_poses_as_they_came_and_goes_on) {
  const Spoilt spoilt(0.015);
  const Skeleton& skeleton = spoilt.walk.clip.skeleton;
  RootMotion root(skeleton, spoilt.roles, spoilt.rate()), same(root);
  FootLock lock(skeleton, spoilt.roles, spoilt.rate()), untouched(lock);
  for (int frame = 0; frame < spoilt.frames(); ++frame) {
    Pose broken = spoilt.pose(frame);
    broken[spoilt.roles.left.shank].x() = std::numeric_limits<float>::quiet_NaN();
    const Pose came = broken;
    root.advance(broken);
    lock.apply(broken, root);
    EXPECT_EQ(broken[spoilt.roles.right.thigh].coeffs(), came[spoilt.roles.right.thigh].coeffs());
    Pose small(3, Eigen::Quaternionf::Identity());
    lock.apply(small, root);
    Pose pose = spoilt.pose(frame), other = pose;
    root.advance(pose);
    same.advance(other);
    lock.apply(pose, root);
    untouched.apply(other, same);
    for (std::size_t joint = 0; joint < pose.size(); ++joint)
      ASSERT_EQ(pose[joint].coeffs(), other[joint].coeffs()) << "frame " << frame;
  }
}

TEST(FootLock, takes_no_memory) {
  if (!ForbiddenMemory::works()) GTEST_SKIP() << "a sanitizer has malloc";
  const Spoilt spoilt(0.02);
  RootMotion root(spoilt.walk.clip.skeleton, spoilt.roles, spoilt.rate());
  FootLock lock(spoilt.walk.clip.skeleton, spoilt.roles, spoilt.rate());
  std::vector<Pose> poses;
  for (int frame = 0; frame < spoilt.frames(); ++frame) poses.push_back(spoilt.pose(frame));
  long allocations = 0, releases = 0;
  {
    const ForbiddenMemory forbidden;
    for (Pose& pose : poses) {
      root.advance(pose);
      lock.apply(pose, root);
    }
    lock.reset();
    allocations = forbidden.allocations(), releases = forbidden.releases();
  }
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(releases, 0);
}

}  // namespace
}  // namespace gait
