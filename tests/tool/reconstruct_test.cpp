// gait reconstruct: same skeleton, rate and frames; output joints from the input joints alone.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <set>
#include <sstream>

#include "gait/files/bvh.h"
#include "gait/motion/body_frame.h"
#include "gait/motion/joint_roles.h"
#include "gait/motion/rotation.h"
#include "walking_takes.h"

namespace gait::testing {
namespace {

// Column of each joint's first channel, and one past the last.
std::vector<Eigen::Index> columns_of(const BvhFile& file) {
  std::vector<Eigen::Index> columns{0};
  for (const auto& channels : file.channels)
    columns.push_back(columns.back() + static_cast<Eigen::Index>(channels.size()));
  return columns;
}

bool is_leg_or_hips(const BvhFile& file, int joint) {
  const auto lower = find_roles(file.skeleton).hips_and_legs();
  return std::find(lower.begin(), lower.end(), joint) != lower.end();
}

// Numbers of any size in place of what hips and legs did.
void drown_legs(BvhFile& file, double most, unsigned seed) {
  std::mt19937 engine(seed);
  const auto columns = columns_of(file);
  for (int joint = 0; joint < file.skeleton.size(); ++joint)
    if (is_leg_or_hips(file, joint))
      for (Eigen::Index column = columns[joint]; column < columns[joint + 1]; ++column)
        for (Eigen::Index frame = 0; frame < file.values.rows(); ++frame)
          file.values(frame, column) =
              most * (2.0 * static_cast<double>(engine()) / 4294967295.0 - 1);
}

class Reconstruct : public ::testing::Test {
 protected:
  void SetUp() override {
    write_takes(folder_ / "seen", 1, 3);
    ASSERT_EQ(train_quickly({folder_ / "seen"}, model()).exit_code, 0);
    write_take(folder_ / "in.bvh", "sad", 4);
  }
  std::string model() const { return folder_ / "m.gait"; }
  BvhFile made(const std::string& in, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"reconstruct", model(), folder_ / in, "-o",
                                       folder_ / "out.bvh"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ToolRun run = run_tool(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return read_bvh(folder_ / "out.bvh");
  }
  TestFolder folder_;
};

TEST_F(Reconstruct, hierarchy_rate_frames_and_input_joints_are_kept) {
  const BvhFile in = read_bvh(folder_ / "in.bvh");
  for (const std::string root : {"feet", "keep"}) {
    const BvhFile out = made("in.bvh", {"--root", root});
    EXPECT_EQ(out.frame_time, in.frame_time);
    ASSERT_EQ(out.values.rows(), in.values.rows());
    ASSERT_EQ(out.channels, in.channels);
    const auto columns = columns_of(in);
    int changed = 0;
    for (int joint = 0; joint < in.skeleton.size(); ++joint) {
      EXPECT_EQ(out.skeleton.joints[joint].name, in.skeleton.joints[joint].name);
      EXPECT_EQ(out.skeleton.joints[joint].offset, in.skeleton.joints[joint].offset);
      const auto width = columns[joint + 1] - columns[joint];
      const bool same = out.values.middleCols(columns[joint], width) ==
                        in.values.middleCols(columns[joint], width);
      EXPECT_EQ(same, !is_leg_or_hips(in, joint)) << in.skeleton.joints[joint].name;
      changed += !same;
    }
    EXPECT_EQ(changed, 7);
  }
}

TEST_F(Reconstruct, nothing_leaks_from_hips_and_legs) {
  const BvhFile in = read_bvh(folder_ / "in.bvh");
  made("in.bvh", {"--csv", folder_ / "true.csv"});
  const std::string truth = bytes_of(folder_ / "out.bvh");
  for (const double most : {0.0, 5.0, 90.0, 720.0}) {
    BvhFile noisy = in;
    drown_legs(noisy, most, 7);
    write_bvh(noisy, folder_ / "noisy.bvh");
    made("noisy.bvh", {"--csv", folder_ / "noisy.csv"});
    EXPECT_TRUE(bytes_of(folder_ / "out.bvh") == truth) << "noise of " << most << " leaks";
    EXPECT_TRUE(bytes_of(folder_ / "noisy.csv") == bytes_of(folder_ / "true.csv"));
  }
}

TEST_F(Reconstruct, legs_are_found_that_look_like_the_true_ones) {
  const Clip truth = clip_from_bvh(read_bvh(folder_ / "in.bvh"));
  const Clip found = clip_from_bvh(made("in.bvh"));
  for (const char* name : {"LeftUpLeg", "LeftLeg", "RightUpLeg", "RightLeg"}) {
    const int joint = truth.skeleton.find(name);
    ASSERT_GE(joint, 0) << name;
    double sum = 0;
    for (int frame = 0; frame < truth.frames(); ++frame)
      sum += angle_between(truth.pose(frame)[joint], found.pose(frame)[joint]);
    EXPECT_LT(sum / truth.frames() * 57.3, 10) << name << ", degrees";
  }
}

TEST_F(Reconstruct, feet_carry_the_root_and_keep_leaves_it) {
  const BvhFile in = read_bvh(folder_ / "in.bvh");
  const Clip truth = clip_from_bvh(in);
  const int last = truth.frames() - 1;
  const Clip feet = clip_from_bvh(made("in.bvh"));
  const double way = (truth.translation(last)[0] - truth.translation(0)[0]).norm();
  const Eigen::Vector3d found = feet.translation(last)[0] - feet.translation(0)[0];
  EXPECT_NEAR(found.z() / way, 1, 0.12) << "ahead along +Z";
  EXPECT_LT(std::abs(feet.translation(0)[0].x()), 0.02 * way) << "from the origin";
  EXPECT_NEAR(feet.translation(0)[0].y(), truth.translation(0)[0].y(), 0.05 * way)
      << "in the file's unit";

  const BvhFile kept = made("in.bvh", {"--root", "keep"});
  EXPECT_EQ(kept.values.leftCols(3), in.values.leftCols(3)) << "the root's place";
}

TEST_F(Reconstruct, delays_are_taken_out_again) {
  const Clip now = clip_from_bvh(made("in.bvh"));
  const Clip late = clip_from_bvh(made("in.bvh", {"--future", "8", "--decoder", "lag"}));
  ASSERT_EQ(late.frames(), now.frames());
  const int thigh = now.skeleton.find("LeftUpLeg");
  // Against itself moved in time: least when not moved at all.
  const auto distance = [&](int shift) {
    double sum = 0;
    for (int frame = 20; frame < now.frames() - 20; ++frame)
      sum += angle_between(now.pose(frame)[thigh], late.pose(frame + shift)[thigh]);
    return sum;
  };
  for (const int shift : {-8, -4, -2, 2, 4, 8}) EXPECT_LT(distance(0), distance(shift)) << shift;
}

TEST_F(Reconstruct, other_frame_rates_and_units_come_back_as_they_were) {
  write_take(folder_ / "fast.bvh", "sad", 4, 4, 120);
  const BvhFile in = read_bvh(folder_ / "fast.bvh");
  const BvhFile out = made("fast.bvh");
  EXPECT_EQ(out.values.rows(), in.values.rows());
  EXPECT_EQ(out.frame_time, in.frame_time);
  const Clip fast = clip_from_bvh(out), slow = clip_from_bvh(made("in.bvh"));
  const int thigh = slow.skeleton.find("RightUpLeg");
  for (int frame = 0; frame < slow.frames(); ++frame)
    EXPECT_LT(angle_between(fast.pose(4 * frame)[thigh], slow.pose(frame)[thigh]), 1e-3) << frame;

  // The same walk in centimetres.
  BvhFile scaled = read_bvh(folder_ / "in.bvh");
  for (Joint& joint : scaled.skeleton.joints) {
    joint.offset *= 100;
    for (Eigen::Vector3d& tip : joint.tips) tip *= 100;
  }
  scaled.values.leftCols(3) *= 100;
  write_bvh(scaled, folder_ / "cm.bvh");
  const Clip cm = clip_from_bvh(made("cm.bvh"));
  for (int frame = 0; frame < slow.frames(); ++frame)
    EXPECT_LT((cm.translation(frame)[0] / 100 - slow.translation(frame)[0]).norm(), 1e-4);
}

TEST_F(Reconstruct, z_up_stays_z_up) {
  Clip turned = clip_from_bvh(read_bvh(folder_ / "in.bvh"));
  const Eigen::Quaterniond to_z_up(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()));
  for (int frame = 0; frame < turned.frames(); ++frame) {
    turned.pose(frame)[0] = to_z_up * turned.pose(frame)[0];
    turned.translation(frame)[0] = to_z_up * turned.translation(frame)[0];
  }
  write_bvh(bvh_from_clip(turned), folder_ / "z.bvh");
  const Clip upright = clip_from_bvh(made("in.bvh")), z = clip_from_bvh(made("z.bvh"));
  for (int frame = 0; frame < z.frames(); ++frame)
    EXPECT_LT((to_z_up * upright.translation(frame)[0] - z.translation(frame)[0]).norm(), 1e-3);
}

TEST_F(Reconstruct, the_table_has_a_row_per_frame_and_names_its_columns) {
  const BvhFile out = made("in.bvh", {"--csv", folder_ / "frames.csv"});
  std::istringstream table(bytes_of(folder_ / "frames.csv"));
  std::string row;
  ASSERT_TRUE(std::getline(table, row));
  EXPECT_EQ(row, "time,step,state,log_likelihood,phase,cadence,style proud,style sad");
  int rows = 0;
  double cadence = 0;
  std::set<std::string> steps;
  for (; std::getline(table, row); ++rows) {
    std::vector<std::string> fields;
    std::istringstream line(row);
    for (std::string field; std::getline(line, field, ',');) fields.push_back(field);
    ASSERT_EQ(fields.size(), 8u) << row;
    EXPECT_NEAR(std::stod(fields[0]), rows * out.frame_time, 1e-4);
    steps.insert(fields[1]);
    EXPECT_GE(std::stod(fields[4]), 0);
    EXPECT_LE(std::stod(fields[4]), 1);
    cadence = std::stod(fields[5]);
    EXPECT_NEAR(std::stod(fields[6]) + std::stod(fields[7]), 1, 1e-5);
  }
  EXPECT_EQ(rows, out.values.rows());
  EXPECT_EQ(steps, (std::set<std::string>{"left", "right"}));
  EXPECT_GT(cadence, 0.8);
  EXPECT_LT(cadence, 3);
}

TEST_F(Reconstruct, joints_that_the_clip_lacks_are_named_and_nothing_is_written) {
  std::string text = bytes_of(folder_ / "in.bvh");
  for (const std::string name : {"RightForeArm", "LeftLeg"}) {
    std::string without = text;
    without.replace(without.find(name), name.size(), "Nobody");
    write_file(folder_ / "lacking.bvh", without);
    const ToolRun run = run_tool({"reconstruct", model(), folder_ / "lacking.bvh", "-o",
                                  folder_ / "x.bvh", "--csv", folder_ / "x.csv"});
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_NE(run.err.find(name), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("lacking.bvh"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "x.bvh"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "x.csv"));
  }
}

TEST_F(Reconstruct, strength_zero_walks_as_the_average_does_and_more_goes_farther) {
  const auto swing = [&](const std::string& strength) {
    const Clip clip = clip_from_bvh(made("in.bvh", {"--strength", strength}));
    const int thigh = clip.skeleton.find("LeftUpLeg");
    const Clip plain = clip_from_bvh(made("in.bvh", {"--strength", "0"}));
    double sum = 0;
    for (int frame = 0; frame < clip.frames(); ++frame)
      sum += angle_between(clip.pose(frame)[thigh], plain.pose(frame)[thigh]);
    return sum / clip.frames();
  };
  EXPECT_EQ(swing("0"), 0);
  EXPECT_GT(swing("1"), 0.01);
  EXPECT_NEAR(swing("1.5") / swing("1"), 1.5, 0.1);
}

}  // namespace
}  // namespace gait::testing
