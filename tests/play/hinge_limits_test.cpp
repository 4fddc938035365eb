#include "gait/play/hinge_limits.h"

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
