#include "gait/files/bvh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "files/small_bvh.h"
#include "gait/error.h"
#include "gait/motion/rotation.h"
#include "shared_data.h"

namespace gait {
namespace {

using testing::bvh_files_below;
using testing::replaced;
using testing::small_bvh;

void expect_same_poses(const Clip& a, const Clip& b) {
  ASSERT_EQ(a.skeleton.size(), b.skeleton.size());
  ASSERT_EQ(a.frames(), b.frames());
  for (std::size_t i = 0; i < a.rotations.size(); ++i) {
    ASSERT_LT(angle_between(a.rotations[i], b.rotations[i]), 1e-12) << "entry " << i;
    ASSERT_EQ(a.translations[i], b.translations[i]) << "entry " << i;
  }
}

TEST(Bvh, reads_what_the_file_says) {
  const BvhFile file = parse_bvh(small_bvh, "small");
  ASSERT_EQ(file.skeleton.size(), 3);
  EXPECT_EQ(file.skeleton.joints[1].name, "Spine");
  EXPECT_EQ(file.skeleton.joints[2].parent, 0);
  EXPECT_EQ(file.skeleton.joints[1].offset, Eigen::Vector3d(0.5, 10, -0.25));
  ASSERT_EQ(file.skeleton.joints[2].tips.size(), 1u);
  EXPECT_EQ(file.skeleton.joints[2].tips[0], Eigen::Vector3d(0, -40, 0));
  EXPECT_EQ(file.channels[2],
            (std::vector{Channel::y_rotation, Channel::z_rotation, Channel::x_rotation}));
  EXPECT_EQ(file.frame_time, 0.0333333);
  ASSERT_EQ(file.values.rows(), 3);
  EXPECT_EQ(file.values(1, 2), 2.25);
  EXPECT_EQ(file.values(2, 11), -5);
  EXPECT_TRUE(file.warnings.empty());
}

TEST(Bvh, spacing_line_ends_and_ways_to_write_numbers_do_not_matter) {
  const BvhFile plain = parse_bvh(small_bvh, "plain");
  const std::string without_end(small_bvh.substr(0, small_bvh.size() - 1));
  for (const std::string& text :
       {replaced(small_bvh, "\n", "\r\n"), replaced(small_bvh, "\n", "\r"), without_end,
        replaced(without_end, "\n", "\r\n"), replaced(small_bvh, " ", "\t"),
        replaced(small_bvh, " ", "  \t "), replaced(small_bvh, "\n", " \n\n"),
        replaced(small_bvh, "\n  {", " {"), replaced(small_bvh, "10 ", "+1.0e+001 "),
        replaced(small_bvh, "0.25", ".25"), replaced(small_bvh, "0.5 ", "5E-1 "),
        replaced(small_bvh, "rotation", "ROTATION"), replaced(small_bvh, "Frames: ", "Frames:"),
        replaced(small_bvh, "Frames:", "Frames :"), replaced(small_bvh, "JOINT", "Joint"),
        "\xEF\xBB\xBF" + std::string(small_bvh), std::string(small_bvh) + "\n \r\n\x1a"}) {
    const BvhFile file = parse_bvh(text, "bent");
    EXPECT_EQ(file.values, plain.values) << text;
    EXPECT_EQ(file.channels, plain.channels);
    EXPECT_EQ(file.frame_time, plain.frame_time);
    for (int joint = 0; joint < 3; ++joint) {
      EXPECT_EQ(file.skeleton.joints[joint].name, plain.skeleton.joints[joint].name);
      EXPECT_EQ(file.skeleton.joints[joint].offset, plain.skeleton.joints[joint].offset);
    }
  }
}

TEST(Bvh, a_joint_may_have_a_name_of_several_words) {
  const BvhFile file = parse_bvh(replaced(small_bvh, "Spine", "Bip01 L Thigh"), "small");
  EXPECT_EQ(file.skeleton.joints[1].name, "Bip01 L Thigh");
  EXPECT_EQ(parse_bvh(bvh_text(file), "again").skeleton.joints[1].name, "Bip01 L Thigh");
}

TEST(Bvh, position_channels_replace_the_offset_each_for_its_axis) {
  const std::string text =
      replaced(small_bvh, "3 Xrotation Yrotation Zrotation", "3 Zposition Yrotation Yposition");
  const Clip clip = clip_from_bvh(parse_bvh(text, "small"));
  EXPECT_EQ(clip.translation(1)[1], Eigen::Vector3d(0.5, 4, 2));
  EXPECT_EQ(clip.translation(1)[2], Eigen::Vector3d(4, -1, 0));
  EXPECT_EQ(clip.translation(1)[0], Eigen::Vector3d(1.5, 91, 2.25));
}

// Every sequence of up to four axes, the product taken as matrices.
TEST(Bvh, rotations_apply_in_the_order_of_the_channels_however_many) {
  const std::array<std::string, 3> names{"Xrotation", "Yrotation", "Zrotation"};
  const std::array<double, 4> degrees{25, -130, 77, 200};
  for (int count = 0; count <= 4; ++count) {
    int sequences = 1;
    for (int n = 0; n < count; ++n) sequences *= 3;
    for (int sequence = 0; sequence < sequences; ++sequence) {
      std::string channels = std::to_string(count), row = "0 0 0 0 0 0";
      Eigen::Matrix3d expected = Eigen::Matrix3d::Identity();
      for (int n = 0, left = sequence; n < count; ++n, left /= 3) {
        channels += " " + names[left % 3];
        row += " " + std::to_string(degrees[n]);
        expected *=
            Eigen::AngleAxisd(degrees[n] * std::numbers::pi / 180, Eigen::Vector3d::Unit(left % 3))
                .toRotationMatrix();
      }
      std::string text = replaced(small_bvh, "3 Xrotation Yrotation Zrotation", channels);
      text = text.substr(0, text.find("Frames")) + "Frames: 1\nFrame Time: 0.1\n" + row + " 0 0 0";
      const Clip clip = clip_from_bvh(parse_bvh(text, "small"));
      EXPECT_LT((clip.pose(0)[1].toRotationMatrix() - expected).norm(), 1e-12) << channels;
    }
  }
}

TEST(Bvh, a_joint_may_lack_its_channels_altogether) {
  std::string text = replaced(small_bvh, "    CHANNELS 3 Xrotation Yrotation Zrotation\n", "");
  for (const char* row : {" 1 2 3", " 2 3 4", " 3 4 5"}) text = replaced(text, row, "");
  const BvhFile file = parse_bvh(text, "small");
  EXPECT_TRUE(file.channels[1].empty());
  EXPECT_TRUE(clip_from_bvh(file).pose(2)[1].isApprox(Eigen::Quaterniond::Identity()));
  EXPECT_EQ(parse_bvh(bvh_text(file), "again").values, file.values);
}

TEST(Bvh, a_file_may_hold_several_roots) {
  const std::string text =
      replaced(small_bvh, "\n\nMOTION", "\nROOT Prop { OFFSET 1 2 3 }\nMOTION");
  const BvhFile file = parse_bvh(text, "small");
  ASSERT_EQ(file.skeleton.size(), 4);
  EXPECT_EQ(file.skeleton.joints[3].parent, -1);
  const BvhFile again = parse_bvh(bvh_text(file), "again");
  EXPECT_EQ(again.skeleton.joints[3].parent, -1);
  EXPECT_EQ(again.skeleton.joints[3].offset, Eigen::Vector3d(1, 2, 3));
}

// Wherever a recording broke off behind its first row: the rows before are used, and said.
TEST(Bvh, a_recording_that_broke_off_is_used_up_to_its_last_whole_row) {
  const std::string small(small_bvh);
  const BvhFile whole = parse_bvh(small, "small.bvh");
  const std::size_t second = small.find("1.5 91"), third = small.find("2 92 2.5");
  for (std::size_t end = second; end + 1 < small.size(); ++end) {
    const BvhFile file = parse_bvh(small.substr(0, end), "small.bvh");
    const int rows = end < third ? 1 : 2;
    ASSERT_EQ(file.values.rows(), rows) << small.substr(second, end - second);
    EXPECT_EQ(file.values, whole.values.topRows(rows));
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_NE(file.warnings[0].find("expected 3 rows"), std::string::npos) << file.warnings[0];
    EXPECT_NE(file.warnings[0].find("found " + std::to_string(rows)), std::string::npos);
  }
  // An editor ended the line, or the header knew of the cut.
  EXPECT_EQ(parse_bvh(small.substr(0, small.size() - 10) + "\n\n", "small.bvh").values.rows(), 2);
  EXPECT_EQ(parse_bvh(replaced(small, "Frames: 3", "Frames: 4"), "small.bvh").values.rows(), 3);
  // A short row with whole ones behind it is damage, not an end.
  EXPECT_THROW(parse_bvh(replaced(small, "2.25 11", "2.25"), "small.bvh"), Error);
}

TEST(Bvh, more_rows_than_announced_are_used_with_a_warning) {
  const BvhFile file = parse_bvh(replaced(small_bvh, "Frames: 3", "Frames: 2"), "small.bvh");
  EXPECT_EQ(file.values.rows(), 3);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].find("small.bvh:"), std::string::npos);
  EXPECT_NE(file.warnings[0].find("expected 2 rows"), std::string::npos);
  EXPECT_NE(file.warnings[0].find("found 3"), std::string::npos);
}

TEST(Bvh, a_rounded_frame_time_means_the_whole_frame_rate) {
  const auto rate = [](const char* time) {
    return clip_from_bvh(parse_bvh(replaced(small_bvh, "0.0333333", time), "small")).frame_rate;
  };
  EXPECT_EQ(rate("0.0333333"), 30);
  EXPECT_EQ(rate("0.033333"), 30);
  EXPECT_EQ(rate(".0083333"), 120);
  EXPECT_EQ(rate("0.008333"), 120);
  EXPECT_EQ(rate("0.041667"), 24);
  EXPECT_EQ(rate("0.0417083750417"), 1 / 0.0417083750417);  // 23.976
  EXPECT_EQ(rate("0.0333667"), 1 / 0.0333667);              // 29.97
}

TEST(Bvh, all_of_the_zoo_reads) {
  GAIT_NEEDS_SHARED_DATA("bvh-zoo");
  int files = 0;
  for (const auto& path : bvh_files_below(testing::shared_data() / "bvh-zoo")) {
    const BvhFile file = read_bvh(path);
    EXPECT_GT(file.values.rows(), 0) << path;
    EXPECT_TRUE(file.warnings.empty()) << file.warnings.front();
    EXPECT_TRUE(clip_from_bvh(file).rotations.front().coeffs().allFinite()) << path;
    ++files;
  }
  EXPECT_GE(files, 23);
}

TEST(Bvh, what_was_written_reads_back_as_the_same_numbers) {
  GAIT_NEEDS_SHARED_DATA("bvh-zoo");
  auto paths = bvh_files_below(testing::shared_data() / "bvh-zoo");
  paths.push_back(testing::shared_data() / "bandai-namco-1/dataset-1_walk_proud_001.bvh");
  paths.push_back(testing::shared_data() / "cmu-walks/08_01.bvh");
  for (const auto& path : paths) {
    const BvhFile file = read_bvh(path);
    const std::string text = bvh_text(file);
    const BvhFile again = parse_bvh(text, "again");
    EXPECT_EQ(again.values, file.values) << path;
    EXPECT_EQ(again.channels, file.channels) << path;
    EXPECT_EQ(again.frame_time, file.frame_time) << path;
    for (int joint = 0; joint < file.skeleton.size(); ++joint) {
      EXPECT_EQ(again.skeleton.joints[joint].name, file.skeleton.joints[joint].name);
      EXPECT_EQ(again.skeleton.joints[joint].parent, file.skeleton.joints[joint].parent);
      EXPECT_EQ(again.skeleton.joints[joint].offset, file.skeleton.joints[joint].offset);
      EXPECT_EQ(again.skeleton.joints[joint].tips, file.skeleton.joints[joint].tips);
    }
    EXPECT_EQ(bvh_text(again), text) << path;
    expect_same_poses(clip_from_bvh(again), clip_from_bvh(file));
  }
}

}  // namespace
}  // namespace gait
