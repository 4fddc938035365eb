#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "files/small_bvh.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"
#include "shared_data.h"

namespace gait {
namespace {

using testing::replaced;
using testing::small_bvh;

constexpr double degree = std::numbers::pi / 180;
constexpr double read_back = 1e-4 * degree;  // what reading back must keep to
const std::array<std::string, 3> names{"Xrotation", "Yrotation", "Zrotation"};
const std::array<std::array<int, 3>, 12> orders{{{0, 1, 2},
                                                 {0, 2, 1},
                                                 {1, 0, 2},
                                                 {1, 2, 0},
                                                 {2, 0, 1},
                                                 {2, 1, 0},
                                                 {0, 1, 0},
                                                 {0, 2, 0},
                                                 {1, 0, 1},
                                                 {1, 2, 1},
                                                 {2, 0, 2},
                                                 {2, 1, 2}}};

std::string order_name(const std::array<int, 3>& order) {
  return names[order[0]] + " " + names[order[1]] + " " + names[order[2]];
}

// One joint with rotations of this order, that many frames of zeros.
BvhFile one_joint(const std::string& channels, int frames) {
  BvhFile file = parse_bvh("HIERARCHY ROOT Hips { OFFSET 0 0 0 CHANNELS 3 " + channels +
                               " }\nMOTION\nFrames: 1\nFrame Time: 0.01\n0 0 0\n",
                           "one.bvh");
  file.values.setZero(frames, 3);
  return file;
}

Eigen::Quaterniond euler(const std::array<int, 3>& order, double a, double b, double c) {
  const auto about = [](int axis, double angle) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle * degree, Eigen::Vector3d::Unit(axis)));
  };
  return about(order[0], a) * about(order[1], b) * about(order[2], c);
}

double largest_error(const BvhFile& file, const std::vector<Eigen::Quaterniond>& expected) {
  const Clip clip = clip_from_bvh(parse_bvh(bvh_text(file), "again"));
  double largest = 0;
  for (int frame = 0; frame < clip.frames(); ++frame)
    largest = std::max(largest, angle_between(clip.pose(frame)[0], expected[frame]));
  return largest;
}

TEST(BvhWriting, any_rotation_reads_back_in_any_order_of_axes) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const auto& order : orders) {
    BvhFile file = one_joint(order_name(order), 2000);
    std::vector<Eigen::Quaterniond> rotations;
    for (int frame = 0; frame < 2000; ++frame) {
      rotations.push_back(
          Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
              .normalized());
      set_rotation(file, frame, 0, rotations.back());
    }
    EXPECT_LT(largest_error(file, rotations), read_back) << order_name(order);
  }
}

TEST(BvhWriting, rotations_at_and_near_gimbal_lock_read_back) {
  for (const auto& order : orders) {
    BvhFile file = one_joint(order_name(order), 0);
    std::vector<Eigen::Quaterniond> rotations;
    for (const double middle : {0.0, 90.0, 180.0, -90.0, 270.0})
      for (const double beside : {0.0, 1e-12, 1e-8, 3e-6, 6e-6, 1.1e-5, 1e-4, 1e-2})
        for (const double first : {0.0, 33.0, 179.9, -120.0})
          rotations.push_back(euler(order, first, middle + beside, 45));
    file.values.setZero(static_cast<int>(rotations.size()), 3);
    for (std::size_t frame = 0; frame < rotations.size(); ++frame)
      set_rotation(file, static_cast<int>(frame), 0, rotations[frame]);
    EXPECT_TRUE(file.values.allFinite());
    EXPECT_LT(largest_error(file, rotations), read_back) << order_name(order);
  }
}

// Angles that wind far beyond a turn and through the other solution's range come back as they were.
TEST(BvhWriting, curves_do_not_jump) {
  for (const auto& order : orders) {
    BvhFile file = one_joint(order_name(order), 1000);
    const bool proper = order[0] == order[2];
    Eigen::MatrixXd expected(1000, 3);
    for (int frame = 0; frame < 1000; ++frame) {
      const double t = frame / 1000.0;
      const double middle = (proper ? 90 : 0) + 60 * std::sin(9 * t);
      expected.row(frame) << 1500 * t, middle, -900 * t + 20 * std::sin(30 * t);
      set_rotation(file, frame, 0,
                   euler(order, expected(frame, 0), expected(frame, 1), expected(frame, 2)));
    }
    EXPECT_LT((file.values - expected).cwiseAbs().maxCoeff(), 2e-6) << order_name(order);
  }
}

// A locked joint leaves one angle free: it stays where it was.
TEST(BvhWriting, a_curve_through_gimbal_lock_stays_near_the_frame_before) {
  BvhFile file = one_joint("Zrotation Xrotation Yrotation", 2);
  file.values.row(0) << 30, 89.9, 20;
  set_rotation(file, 1, 0, euler({2, 0, 1}, 31, 90, 20));
  EXPECT_LT((file.values.row(1) - file.values.row(0)).cwiseAbs().maxCoeff(), 1);
}

TEST(BvhWriting, the_first_frame_does_not_depend_on_what_the_file_held) {
  BvhFile zero = one_joint("Zrotation Xrotation Yrotation", 1), noise = zero;
  noise.values.row(0) << 1234, -567, 890;
  const Eigen::Quaterniond rotation = euler({2, 0, 1}, 10, 20, 30);
  set_rotation(zero, 0, 0, rotation);
  set_rotation(noise, 0, 0, rotation);
  EXPECT_EQ(zero.values, noise.values);
  EXPECT_LT((zero.values.row(0) - Eigen::RowVector3d(10, 20, 30)).norm(), 2e-6);
}

TEST(BvhWriting, a_joint_whose_channels_cannot_take_any_rotation_is_named) {
  for (const std::string channels :
       {"2 Xrotation Yrotation", "1 Zrotation", "0", "4 Xrotation Yrotation Zrotation Xrotation",
        "3 Xrotation Xrotation Yrotation", "3 Xposition Yposition Zposition"}) {
    const int count = channels[0] - '0';
    std::string row = "\n";
    for (int n = 0; n < count + 1; ++n) row += "0 ";
    BvhFile file = parse_bvh(
        "HIERARCHY ROOT Hips { OFFSET 0 0 0 CHANNELS 1 Xposition JOINT Knee "
        "{ OFFSET 0 0 0 CHANNELS " +
            channels + " } }\nMOTION\nFrames: 1\nFrame Time: 0.01" + row,
        "one.bvh");
    EXPECT_FALSE(takes_rotation(file, 1));
    try {
      set_rotation(file, 0, 1, Eigen::Quaterniond::Identity());
      FAIL() << channels;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("'Knee'"), std::string::npos) << error.what();
    }
  }
}

TEST(BvhWriting, setting_one_joint_leaves_the_numbers_of_others_alone) {
  const BvhFile before = parse_bvh(small_bvh, "small");
  BvhFile file = before;
  for (int frame = 0; frame < 3; ++frame) {
    set_rotation(file, frame, 1, Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5));
    set_translation(file, frame, 1, {1, 2, 3});  // it has no position channels
  }
  const BvhFile again = parse_bvh(bvh_text(file), "again");
  EXPECT_EQ(again.values.leftCols(6), before.values.leftCols(6));
  EXPECT_EQ(again.values.rightCols(3), before.values.rightCols(3));
  EXPECT_NE(again.values.middleCols(6, 3), before.values.middleCols(6, 3));
  set_translation(file, 1, 0, {7, 8, 9});
  EXPECT_EQ(clip_from_bvh(file).translation(1)[0], Eigen::Vector3d(7, 8, 9));
}

TEST(BvhWriting, any_double_reads_back_as_itself) {
  std::mt19937_64 random(11);
  BvhFile file = parse_bvh(small_bvh, "small");
  file.values.resize(500, 12);
  std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-320, 8.9);
  for (double& value : file.values.reshaped())
    value = mantissa(random) * std::pow(10.0, exponent(random));
  file.values.row(0) << 0, -0.0, 1e-5, 9.999999999e-6, 100000, 999999999, 0.1, 1.0 / 3, 5e-324, 1e9,
      -123456.789, 2e-17;
  file.frame_time = 1001.0 / 24000;
  const BvhFile again = parse_bvh(bvh_text(file), "again");
  EXPECT_EQ(again.values, file.values);
  EXPECT_EQ(again.frame_time, file.frame_time);
}

// Joints in an order that nesting cannot give are written in one that it can, with their values.
TEST(BvhWriting, a_clip_from_nowhere_becomes_a_file_with_the_same_motion) {
  Clip clip;
  clip.frame_rate = 30;
  clip.skeleton.joints = {{"Hips", -1, {0, 0, 0}, {}},
                          {"Left", 0, {1, 0, 0}, {{0, 1, 0}}},
                          {"Right", 0, {-1, 0, 0}, {}},
                          {"LeftEnd", 1, {0, -1, 0}, {}},
                          {"RightEnd", 2, {0, -1, 0}, {}}};
  clip.resize(20);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int frame = 0; frame < 20; ++frame) {
    clip.translation(frame)[0] = {0.1 * frame, 1, 0.01 * frame};
    clip.translation(frame)[4] = {0, -1 - 0.01 * frame, 0};  // slides against its offset
    for (Eigen::Quaterniond& rotation : clip.pose(frame))
      rotation = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                     .normalized();
  }
  const testing::TemporaryFolder folder;
  write_bvh(bvh_from_clip(clip), folder / "clip.bvh");
  const Clip again = clip_from_bvh(read_bvh(folder / "clip.bvh"));
  EXPECT_EQ(again.frame_rate, 30);
  ASSERT_EQ(again.frames(), 20);
  const WorldPoses expected = world_poses(clip), found = world_poses(again);
  for (int joint = 0; joint < 5; ++joint) {
    const int there = again.skeleton.find(clip.skeleton.joints[joint].name);
    ASSERT_GE(there, 0);
    for (int frame = 0; frame < 20; ++frame) {
      EXPECT_LT((expected.positions[frame * 5 + joint] - found.positions[frame * 5 + there]).norm(),
                1e-7);
      EXPECT_LT(angle_between(clip.pose(frame)[joint], again.pose(frame)[there]), read_back);
    }
  }
}

TEST(BvhWriting, real_motion_set_anew_reads_back) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-2");
  for (const char* name :
       {"bandai-namco-2/dataset-2_walk_elderly_001.bvh", "cmu-walks/35_01.bvh",
        "bvh-zoo/pybvh/bvh_test3.bvh", "bvh-zoo/pybvh/rotation_first_root.bvh"}) {
    BvhFile file = read_bvh(testing::shared_data() / name);
    const Clip clip = clip_from_bvh(file);
    file.values.setZero();
    for (int frame = 0; frame < clip.frames(); ++frame)
      for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
        set_rotation(file, frame, joint, clip.pose(frame)[joint]);
        set_translation(file, frame, joint, clip.translation(frame)[joint]);
      }
    const Clip again = clip_from_bvh(parse_bvh(bvh_text(file), name));
    double largest = 0;
    for (std::size_t i = 0; i < clip.rotations.size(); ++i)
      largest = std::max(largest, angle_between(clip.rotations[i], again.rotations[i]));
    EXPECT_LT(largest, read_back) << name;
    EXPECT_EQ(again.translations, clip.translations) << name;
  }
}

TEST(BvhWriting, a_file_is_replaced_whole_or_not_at_all) {
  const testing::TemporaryFolder folder;
  const BvhFile file = parse_bvh(small_bvh, "small");
  write_bvh(file, folder / "walk.bvh");
  write_bvh(file, folder / "walk.bvh");
  EXPECT_EQ(read_bvh(folder / "walk.bvh").values, file.values);
  EXPECT_FALSE(std::filesystem::exists(folder / "walk.bvh.part"));
  EXPECT_THROW(write_bvh(file, folder / "missing/walk.bvh"), Error);
  std::filesystem::create_directories(folder / "taken.bvh/inside");
  EXPECT_THROW(write_bvh(file, folder / "taken.bvh"), Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "taken.bvh.part"));
}

TEST(BvhWriting, a_name_that_no_file_can_hold_is_an_error) {
  BvhFile file = parse_bvh(small_bvh, "small");
  for (const char* name : {"", "a{b", "two\nlines"}) {
    file.skeleton.joints[1].name = name;
    EXPECT_THROW(bvh_text(file), Error) << name;
  }
}

}  // namespace
}  // namespace gait
