#include "gait/play/cycles/hinge_limits.h"

#include <gtest/gtest.h>

#include "play/few_walks.h"
#include "play/forbidden_memory.h"

namespace gait {
namespace {

using testing::few_walks_model;

using Pose = std::vector<Eigen::Quaternionf>;

// The body at rest, one hinge turned to an angle about its axis.
Pose bent(const Body& body, const Hinge& hinge, float angle) {
  Pose pose(body.references.size(), Eigen::Quaternionf::Identity());
  const Eigen::Vector3f axis = hinge.axis.cast<float>();
  const float rest =
      hinge_bones<float>(body.skeleton, hinge, std::span<const Eigen::Quaternionf>(pose))
          .angle(axis);
  pose[hinge.joint] = Eigen::AngleAxisf(angle - rest, axis) * pose[hinge.joint];
  return pose;
}

float angle_of(const Body& body, const Hinge& hinge, const Pose& pose) {
  return hinge_bones<float>(body.skeleton, hinge, std::span<const Eigen::Quaternionf>(pose))
      .angle(hinge.axis.cast<float>());
}

TEST(HingeLimits, are_those_of_the_walks_that_were_learnt_from) {
  const Body& body = *few_walks_model()->body;
  ASSERT_GE(body.hinges.size(), 2u);
  for (std::size_t knee = 0; knee < 2; ++knee) {
    EXPECT_GT(body.hinges[knee].least, 0.1);  // the built-in walks' bend by 7 degrees at least
    EXPECT_LT(body.hinges[knee].most, 2);
    EXPECT_GT(body.hinges[knee].most, 0.8);
    EXPECT_GT(std::abs(body.hinges[knee].axis.x()), 0.95);
  }
}

TEST(HingeLimits, give_way_little_by_little_and_change_nothing_within) {
  const Body& body = *few_walks_model()->body;
  const HingeLimits limits(body);
  for (const Hinge& hinge : body.hinges) {
    const auto least = static_cast<float>(hinge.least), most = static_cast<float>(hinge.most);
    float before = -1;
    for (float angle = least - 0.6f; angle < most + 0.6f; angle += 0.005f) {
      const Pose came = bent(body, hinge, angle);
      Pose pose = came;
      limits.apply(pose);
      const float is = angle_of(body, hinge, pose);
      EXPECT_GT(is, least - 1e-3f);
      EXPECT_LT(is, most + 1e-3f);
      if (before > -1) {
        EXPECT_GT(is, before - 1e-3f);
        EXPECT_LT(is, before + 0.006f);
      }
      before = is;
      if (angle > least + 0.05f && angle < most - 0.05f) {
        EXPECT_NEAR(is, angle, 1e-5f);
      }
      for (std::size_t joint = 0; joint < pose.size(); ++joint) {
        const bool is_hinge = std::ranges::any_of(body.hinges, [&](const Hinge& other) {
          return other.joint == static_cast<int>(joint);
        });
        if (!is_hinge) {
          EXPECT_EQ(pose[joint].coeffs(), came[joint].coeffs());
        }
      }
    }
  }
}

TEST(HingeLimits, go_to_the_nearer_end_from_behind_and_may_be_narrow) {
  Body body = *few_walks_model()->body;
  body.hinges.resize(1);
  Hinge& knee = body.hinges.front();
  for (const auto& [least, most] : {std::pair(0.1, 1.2), {0.1, 0.12}, {0.3, 0.3}}) {
    knee.least = least, knee.most = most;
    const HingeLimits limits(body);
    for (const auto& [angle, expected] :
         {std::pair(3.1f, most), {3.2f, most}, {-1.0f, least}, {0.5f, std::min(0.5, most)}}) {
      Pose pose = bent(body, knee, angle);
      limits.apply(pose);
      EXPECT_NEAR(angle_of(body, knee, pose), expected, 1e-3) << angle;
    }
  }
}

TEST(HingeLimits, are_not_learnt_where_a_joint_bends_about_many_axes) {
  std::vector<Walk> walks = testing::few_walks();
  const Clip& first = walks.front().clip;
  const int forearm = find_roles(first.skeleton).joint(Role::left_forearm);
  const std::size_t before = few_walks_model()->body->hinges.size();
  for (Walk& walk : walks)
    for (int frame = 0; frame < walk.clip.frames(); ++frame)
      walk.clip.pose(frame)[forearm] =
          Eigen::AngleAxisd(0.2 * frame, Eigen::Vector3d::UnitX()) * walk.clip.pose(frame)[forearm];
  EXPECT_EQ(walk_sequences(walks, {}).body.hinges.size(), before - 1);
}

TEST(HingeLimits, leave_poses_as_they_are_where_none_were_learnt) {
  Body body = *few_walks_model()->body;
  const Pose came = bent(body, body.hinges.front(), -2);
  body.hinges.clear();
  Pose pose = came;
  HingeLimits(body).apply(pose);
  for (std::size_t joint = 0; joint < pose.size(); ++joint)
    EXPECT_EQ(pose[joint].coeffs(), came[joint].coeffs());
}

TEST(HingeLimits, take_no_memory) {
  if (!testing::ForbiddenMemory::works()) GTEST_SKIP() << "a sanitizer has malloc";
  const Body& body = *few_walks_model()->body;
  const HingeLimits limits(body);
  Pose pose = bent(body, body.hinges.front(), -2);
  long allocations = 0;
  {
    const testing::ForbiddenMemory forbidden;
    limits.apply(pose);
    allocations = forbidden.allocations();
  }
  EXPECT_EQ(allocations, 0);
}

}  // namespace
}  // namespace gait
