#include "gait/motion/hinge.h"

#include <gtest/gtest.h>

#include "gait/corpus/corpus.h"
#include "gait/motion/kinematics.h"

namespace gait {
namespace {

using Pose = std::vector<Eigen::Quaterniond>;

// Thigh, a joint between, shank, a joint between, foot; straight down.
Skeleton leg() {
  Skeleton skeleton;
  skeleton.joints = {{"Thigh", -1, {0, 1, 0}, {}},
                     {"ThighTwist", 0, {0, -0.2, 0}, {}},
                     {"Shank", 1, {0, -0.25, 0}, {{0, -0.1, 0}}},
                     {"ShankTwist", 2, {0, -0.2, 0}, {}},
                     {"Foot", 3, {0, -0.2, 0}, {}}};
  return skeleton;
}

Hinge knee() {
  Hinge hinge;
  hinge.above = 0, hinge.joint = 2, hinge.below = 4;
  return hinge;
}

Eigen::Quaterniond turned(double angle, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

TEST(Hinge, tells_how_far_it_bends_and_which_way) {
  const Skeleton skeleton = leg();
  for (const double bend : {-1.0, -0.1, 0.0, 0.3, 2.5}) {
    Pose pose(5, Eigen::Quaterniond::Identity());
    pose[0] = turned(0.7, {0, 0, 1});  // the leg itself lies anyhow
    pose[1] = turned(0.4, {0, 1, 0});  // twists do not bend
    pose[3] = turned(-0.6, {0, 1, 0});
    pose[2] = turned(bend, {1, 0, 0});
    const auto bones =
        hinge_bones<double>(skeleton, knee(), std::span<const Eigen::Quaterniond>(pose));
    EXPECT_NEAR(bones.angle({1, 0, 0}), bend, 1e-12);
    EXPECT_NEAR(bones.angle({-1, 0, 0}), -bend, 1e-12);
    EXPECT_NEAR(bones.above.norm(), 0.45, 1e-12);
    EXPECT_NEAR(bones.below.norm(), 0.4, 1e-12);
  }
}

TEST(Hinge, goes_to_the_tip_where_there_is_no_joint_below) {
  const Skeleton skeleton = leg();
  Hinge hinge = knee();
  hinge.below = -1;
  Pose pose(5, Eigen::Quaterniond::Identity());
  pose[2] = turned(0.3, {1, 0, 0});
  const auto bones =
      hinge_bones<double>(skeleton, hinge, std::span<const Eigen::Quaterniond>(pose));
  EXPECT_NEAR(bones.below.norm(), 0.1, 1e-12);
  EXPECT_NEAR(bones.angle({1, 0, 0}), 0.3, 1e-12);
}

TEST(Hinge, agrees_with_where_joints_are) {
  const CorpusWalk walk = make_walk({});
  const Skeleton& skeleton = walk.clip.skeleton;
  const std::vector<Hinge> hinges = find_hinges(skeleton, find_roles(skeleton));
  ASSERT_GE(hinges.size(), 4u);  // knees and elbows
  const WorldPoses world = world_poses(walk.clip);
  const auto at = [&](int frame, int joint) {
    return world.positions[static_cast<std::size_t>(frame) * skeleton.joints.size() +
                           static_cast<std::size_t>(joint)];
  };
  for (const Hinge& hinge : hinges) {
    if (hinge.below < 0) continue;
    for (int frame = 0; frame < walk.clip.frames(); frame += 7) {
      const auto bones = hinge_bones<double>(skeleton, hinge, walk.clip.pose(frame));
      const Eigen::Vector3d above = at(frame, hinge.joint) - at(frame, hinge.above),
                            below = at(frame, hinge.below) - at(frame, hinge.joint);
      EXPECT_NEAR(bones.above.norm(), above.norm(), 1e-9);
      EXPECT_NEAR(bones.above.dot(bones.below), above.dot(below), 1e-9);
      // The same turn in the world as in the frame of the hinge's parent.
      const auto parent = static_cast<std::size_t>(frame) * skeleton.joints.size() +
                          static_cast<std::size_t>(skeleton.joints[hinge.joint].parent);
      EXPECT_LT(
          (world.rotations[parent] * bones.above.cross(bones.below) - above.cross(below)).norm(),
          1e-9);
    }
  }
}

TEST(Hinge, is_found_only_where_its_bones_are) {
  Skeleton apart = leg();
  JointRoles roles = find_roles(apart);
  roles.right = {4, 2, 0, -1};  // upside down
  roles.left = {};
  EXPECT_TRUE(find_hinges(apart, roles).empty());
}

}  // namespace
}  // namespace gait
