#include "gait/motion/rest_calibration.h"

#include <gtest/gtest.h>

#include <random>

#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"

namespace gait {
namespace {

Skeleton rig(const Eigen::Vector3d& upper, const Eigen::Vector3d& lower) {
  Skeleton skeleton;
  skeleton.joints.push_back({"Hips", -1, {0, 1, 0}, {}});
  skeleton.joints.push_back({"Spine", 0, {0, 0.2, 0.01}, {}});
  skeleton.joints.push_back({"LeftArm", 1, upper, {}});
  skeleton.joints.push_back({"LeftHand", 2, lower, {{0.1, 0, 0}}});
  skeleton.joints.push_back({"RightArm", 1, {-0.2, 0.1, 0}, {}});
  return skeleton;
}

Clip moving(const Skeleton& skeleton) {
  Clip clip;
  clip.skeleton = skeleton;
  clip.resize(20);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (auto& rotation : clip.rotations)
    rotation = exponential_map<double>({normal(random), normal(random), normal(random)});
  return clip;
}

const Skeleton t_pose = rig({0.2, 0.1, 0}, {0.3, 0, 0});
const Skeleton arms_down = rig({0.18, 0.12, 0.02}, {0.1, -0.28, 0.02});

TEST(RestCalibration, every_joint_stays_where_it_is) {
  const Clip clip = moving(arms_down);
  const Clip turned = with_rest_turned(clip, rest_turns(arms_down, t_pose));
  const WorldPoses before = world_poses(clip), after = world_poses(turned);
  for (std::size_t i = 0; i < before.positions.size(); ++i)
    EXPECT_LT((before.positions[i] - after.positions[i]).norm(), 1e-12);
}

TEST(RestCalibration, bones_rest_as_the_other_rig_has_them) {
  const Clip turned = with_rest_turned(moving(arms_down), rest_turns(arms_down, t_pose));
  // A single bone exactly, several as well as one rotation can.
  EXPECT_LT((turned.skeleton.joints[3].offset.normalized() - Eigen::Vector3d::UnitX()).norm(),
            1e-9);
  for (int joint : {1, 2, 4}) {
    const auto direction = turned.skeleton.joints[joint].offset.normalized();
    EXPECT_GT(direction.dot(t_pose.joints[joint].offset.normalized()), std::cos(0.17));
  }
}

TEST(RestCalibration, turning_back_gives_the_first_rotations) {
  const Clip clip = moving(arms_down);
  const auto turns = rest_turns(arms_down, t_pose);
  const Clip turned = with_rest_turned(clip, turns);
  for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
    const int parent = clip.skeleton.joints[joint].parent;
    const auto back = rest_turned_back(turned.pose(7)[joint], turns[joint],
                                       parent < 0 ? Eigen::Quaterniond::Identity() : turns[parent]);
    EXPECT_LT(angle_between(back, clip.pose(7)[joint]), 1e-7);
  }
}

TEST(RestCalibration, a_rig_is_not_turned_onto_itself) {
  for (const auto& turn : rest_turns(t_pose, t_pose))
    EXPECT_LT(angle_between(turn, Eigen::Quaterniond::Identity()), 1e-7);
}

}  // namespace
}  // namespace gait
