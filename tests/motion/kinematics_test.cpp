#include "gait/motion/kinematics.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "gait/files/bvh.h"
#include "shared_data.h"

namespace gait {
namespace {

TEST(Kinematics, agrees_with_products_of_transformations) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  Clip clip;
  clip.skeleton.joints.push_back({"0", -1, {0, 0, 0}, {}});
  for (int joint = 1; joint < 30; ++joint)
    clip.skeleton.joints.push_back(
        {std::to_string(joint), static_cast<int>(random() % joint), {0, 0, 0}, {}});
  clip.resize(3);
  for (auto& rotation : clip.rotations)
    rotation = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                   .normalized();
  for (auto& translation : clip.translations)
    translation = {normal(random), normal(random), normal(random)};

  const WorldPoses world = world_poses(clip);
  for (int frame = 0; frame < 3; ++frame)
    for (int joint = 0; joint < 30; ++joint) {
      Eigen::Isometry3d expected = Eigen::Isometry3d::Identity();
      for (int at = joint; at >= 0; at = clip.skeleton.joints[at].parent) {
        Eigen::Isometry3d local = Eigen::Isometry3d::Identity();
        local.rotate(clip.pose(frame)[at]).pretranslate(clip.translation(frame)[at]);
        expected = local * expected;
      }
      const std::size_t i = static_cast<std::size_t>(frame) * 30 + joint;
      EXPECT_LT((world.positions[i] - expected.translation()).norm(), 1e-12);
      EXPECT_LT((world.rotations[i].toRotationMatrix() - expected.linear()).norm(), 1e-12);
    }
}

// 1e-3 of the file's unit: what the figures were given with.
TEST(Kinematics, agrees_with_an_independent_reader_on_files_of_many_makers) {
  GAIT_NEEDS_SHARED_DATA("fk-golden.json");
  std::ifstream stream(testing::shared_data() / "fk-golden.json");
  const auto golden = nlohmann::json::parse(stream).at("files");
  double largest = 0;
  for (const auto& [name, truth] : golden.items()) {
    const BvhFile file = read_bvh(testing::shared_data() / name);
    const Clip clip = clip_from_bvh(file);
    const WorldPoses world = world_poses(clip);
    ASSERT_EQ(clip.skeleton.joints.size(), truth.at("joints").size()) << name;
    EXPECT_EQ(clip.frames(), truth.at("frames").get<int>()) << name;
    EXPECT_NEAR(file.frame_time, truth.at("frame_time").get<double>(), 1e-12) << name;
    for (std::size_t sample = 0; sample < truth.at("at").size(); ++sample) {
      const std::size_t frame = truth["at"][sample].get<std::size_t>();
      for (std::size_t joint = 0; joint < clip.skeleton.joints.size(); ++joint) {
        EXPECT_EQ(clip.skeleton.joints[joint].name, truth["joints"][joint].get<std::string>());
        const auto& p = truth.at("positions")[sample][joint];
        const Eigen::Vector3d expected(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
        const double error =
            (world.positions[frame * clip.skeleton.joints.size() + joint] - expected).norm();
        EXPECT_LT(error, 1e-3) << name << " frame " << frame << " joint "
                               << clip.skeleton.joints[joint].name;
        largest = std::max(largest, error);
      }
    }
  }
  EXPECT_GE(golden.size(), 23u);
  RecordProperty("largest_error", std::to_string(largest));
}

}  // namespace
}  // namespace gait
