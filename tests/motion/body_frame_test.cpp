#include "gait/motion/body_frame.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "files/small_bvh.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"
#include "shared_data.h"

namespace gait {
namespace {

// A person with legs of 0.85 m, in metres, Y up, who bends and turns a little.
Clip person() {
  Clip clip;
  clip.name = "person";
  clip.skeleton.joints = {{"Hips", -1, {0, 0, 0}, {}},
                          {"LeftUpLeg", 0, {0.1, -0.05, 0}, {}},
                          {"LeftLeg", 1, {0, -0.43, 0}, {}},
                          {"LeftFoot", 2, {0, -0.42, 0}, {{0, -0.05, 0.15}}},
                          {"RightUpLeg", 0, {-0.1, -0.05, 0}, {}},
                          {"RightLeg", 4, {0, -0.43, 0}, {}},
                          {"RightFoot", 5, {0, -0.42, 0}, {{0, -0.05, 0.15}}},
                          {"Spine", 0, {0, 0.25, 0}, {}},
                          {"Head", 7, {0, 0.35, 0.02}, {{0, 0.2, 0}}}};
  clip.resize(30);
  for (int frame = 0; frame < 30; ++frame) {
    const double swing = 0.4 * std::sin(frame * 0.2);
    clip.translation(frame)[0] = {0.01, 0.95, 0.04 * frame};
    clip.pose(frame)[0] = exponential_map<double>({0.05, 0.1 * swing, 0.02});
    clip.pose(frame)[1] = exponential_map<double>({swing, 0, 0});
    clip.pose(frame)[4] = exponential_map<double>({-swing, 0, 0});
    clip.pose(frame)[2] = exponential_map<double>({0.3, 0, 0});
  }
  return clip;
}

// As a program with other axes and another unit would have written it: rest pose, root and all.
Clip seen_from(const Clip& clip, const Eigen::Quaterniond& turn, double units_per_metre) {
  Clip other = clip;
  for (Joint& joint : other.skeleton.joints) {
    joint.offset = turn * joint.offset * units_per_metre;
    for (Eigen::Vector3d& tip : joint.tips) tip = turn * tip * units_per_metre;
  }
  for (auto& translation : other.translations) translation = turn * translation * units_per_metre;
  for (auto& rotation : other.rotations) rotation = turn * rotation * turn.conjugate();
  return other;
}

// Largest distance between the joints' places, but for a turn about the vertical: which way is
// ahead is nobody's business here.
double largest_difference(const Clip& a, const Clip& b) {
  const auto first = world_poses(a).positions, second = world_poses(b).positions;
  const std::size_t last = first.size() - 1;
  const Eigen::Vector3d from = second[last] - second[0], to = first[last] - first[0];
  const Eigen::Quaterniond turn =
      about_vertical(std::atan2(to.x(), to.z()) - std::atan2(from.x(), from.z()));
  const Eigen::Vector3d shift = first[0] - turn * second[0];
  double largest = 0;
  for (std::size_t i = 0; i < first.size(); ++i)
    largest = std::max(largest, (first[i] - (turn * second[i] + shift)).norm());
  return largest;
}

BodyFrame guess(const Clip& clip, const BodyFrameOverride& said = {}) {
  return guess_body_frame(clip, find_roles(clip.skeleton), said);
}

const std::array<Eigen::Vector3d, 5> ups{{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}}};

TEST(BodyFrame, any_unit_and_upright_axis_comes_out_in_metres_with_y_up) {
  const Clip clip = person();
  for (const char* unit : {"m", "cm", "mm", "in", "ft", "dm", "cmu"})
    for (const Eigen::Vector3d& up : ups) {
      const double metres = metres_per_unit_named(unit);
      const auto turn = turn_between(Eigen::Vector3d::UnitY(), up);
      const Clip file = seen_from(clip, turn, 1 / metres);
      const BodyFrame frame = guess(file);
      EXPECT_EQ(frame.metres_per_unit, metres) << unit;
      EXPECT_LT((frame.to_y_up * up - Eigen::Vector3d::UnitY()).norm(), 1e-12) << up.transpose();
      EXPECT_EQ(frame.warnings.empty(), up.minCoeff() >= 0);  // upside down is said
      const Clip ours = in_metres_y_up(file, frame);
      EXPECT_LT(largest_difference(clip, ours), 1e-9) << unit << " up " << up.transpose();
      EXPECT_NEAR(world_poses(ours).positions[0].y(), 0.95, 1e-9);
    }
}

TEST(BodyFrame, what_comes_back_into_the_file_is_what_was_there) {
  const Clip file = seen_from(person(), Eigen::Quaterniond(0.5, 0.5, 0.5, 0.5), 39.37);
  const BodyFrame frame = guess(file);
  const Clip ours = in_metres_y_up(file, frame);
  for (int t = 0; t < file.frames(); ++t) {
    EXPECT_LT(angle_between(root_rotation_in_file(ours.pose(t)[0], frame), file.pose(t)[0]), 1e-7);
    EXPECT_LT(
        (root_translation_in_file(ours.translation(t)[0], frame) - file.translation(t)[0]).norm(),
        1e-9);
    EXPECT_EQ(ours.pose(t)[2].coeffs(), file.pose(t)[2].coeffs());
  }
}

TEST(BodyFrame, what_the_user_says_goes_before_any_guess) {
  const Clip clip = seen_from(person(), Eigen::Quaterniond::Identity(), 100);
  const BodyFrame frame = guess(clip, {.metres_per_unit = 0.5, .up_axis = 'z'});
  EXPECT_EQ(frame.metres_per_unit, 0.5);
  EXPECT_LT((frame.to_y_up * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_TRUE(frame.warnings.empty());
  EXPECT_THROW(guess(clip, {.metres_per_unit = {}, .up_axis = 'w'}), Error);
  EXPECT_THROW(guess(clip, {.metres_per_unit = 0.0, .up_axis = {}}), Error);
}

bool warns_of(const BodyFrame& frame, const std::string& flag) {
  for (const std::string& warning : frame.warnings)
    if (warning.find(flag) != std::string::npos) return true;
  return false;
}

TEST(BodyFrame, a_doubtful_guess_gives_a_warning_that_names_the_flag) {
  Clip giant = seen_from(person(), Eigen::Quaterniond::Identity(), 5.5);  // between ft and dm
  EXPECT_TRUE(warns_of(guess(giant), "--unit"));
  EXPECT_FALSE(warns_of(guess(giant), "--up"));

  Clip leaning = person();
  for (int t = 0; t < leaning.frames(); ++t)
    leaning.pose(t)[0] = exponential_map<double>({0.75, 0, 0});
  EXPECT_TRUE(warns_of(guess(leaning), "--up"));
  EXPECT_FALSE(warns_of(guess(leaning), "--unit"));

  Clip on_its_head = seen_from(person(), Eigen::Quaterniond(0, 1, 0, 0), 1);
  EXPECT_TRUE(warns_of(guess(on_its_head), "--up"));

  Clip nameless = person();
  for (Joint& joint : nameless.skeleton.joints) joint.name = "J";
  EXPECT_FALSE(warns_of(guess(nameless), "--unit")) << "its tree shows its legs";
  const BodyFrame frame = guess_body_frame(nameless, JointRoles{});
  EXPECT_TRUE(warns_of(frame, "--unit"));
  EXPECT_TRUE(warns_of(frame, "--up"));
  EXPECT_EQ(frame.metres_per_unit, 1);

  Clip empty = person();
  empty.resize(0);
  EXPECT_TRUE(warns_of(guess(empty), "--unit"));
  EXPECT_TRUE(warns_of(guess(empty), "--up"));
}

TEST(BodyFrame, units_are_named_or_given_as_a_number) {
  EXPECT_EQ(metres_per_unit_named("in"), 0.0254);
  EXPECT_EQ(metres_per_unit_named("0.056444"), 0.056444);
  for (const char* unit : {"", "parsec", "0", "-1", "nan", "inf", "1e300", "0.01 m"})
    EXPECT_THROW(metres_per_unit_named(unit), Error) << unit;
}

// What the makers say of their files, or what their bodies' height leaves no doubt about.
TEST(BodyFrame, files_of_many_makers_are_judged_right) {
  GAIT_NEEDS_SHARED_DATA("bvh-zoo");
  struct Expected {
    const char* unit;
    char up;
  };
  const std::map<std::string, Expected> zoo{{"bvh-python/test_freebvh", {"cm", 'y'}},
                                            {"bvh-python/test_mocapbank", {"cm", 'y'}},
                                            {"bvh-toolbox/test_mocapbank", {"cm", 'y'}},
                                            {"bvh-toolbox/walk01", {"cm", 'y'}},
                                            {"bvh11_cmu_max/131_01", {"cmu", 'y'}},
                                            {"bvh11_cmu_max/131_02", {"cmu", 'y'}},
                                            {"bvh11_cmu_max/scaled_131_01", {"m", 'y'}},
                                            {"bvhio/example", {"in", 'y'}},
                                            {"makehuman/walk1", {"dm", 'z'}},
                                            {"makehuman/zombieWalk1", {"dm", 'z'}},
                                            {"makehuman/face-poseunits", {"dm", 'z'}},
                                            {"motionmachine/animation", {"cm", 'y'}},
                                            {"pybvh/bvh_example", {"in", 'z'}},
                                            {"pybvh/bvh_test1", {"in", 'z'}},
                                            {"pybvh/bvh_test2", {"cm", 'y'}},
                                            {"pybvh/bvh_test3", {"in", 'z'}},
                                            {"pybvh/cmu_12_01_walk", {"cmu", 'y'}},
                                            {"pybvh/standard_skeleton", {"in", 'z'}}};
  for (const auto& [name, expected] : zoo) {
    const Clip clip = clip_from_bvh(read_bvh(testing::shared_data() / "bvh-zoo" / (name + ".bvh")));
    const BodyFrame frame = guess(clip);
    EXPECT_EQ(frame.metres_per_unit, metres_per_unit_named(expected.unit)) << name;
    const Eigen::Vector3d up = Eigen::Vector3d::Unit(expected.up - 'x');
    EXPECT_LT((frame.to_y_up * up - Eigen::Vector3d::UnitY()).norm(), 1e-12) << name;
    EXPECT_TRUE(frame.warnings.empty()) << frame.warnings.front();
  }
  // Pose files whose position channels put every bone's length to nothing: no unit can be told.
  for (const char* name : {"makehuman/benchmark.bvh", "makehuman/tpose.bvh"})
    EXPECT_TRUE(warns_of(guess(clip_from_bvh(read_bvh(testing::shared_data() / "bvh-zoo" / name))),
                         "--unit"));
}

TEST(BodyFrame, all_captured_walks_are_judged_right_and_without_doubt) {
  GAIT_NEEDS_SHARED_DATA("bandai-namco-1");
  int clips = 0;
  for (const char* folder : {"bandai-namco-1", "bandai-namco-2", "cmu-walks"})
    for (const auto& path : testing::bvh_files_below(testing::shared_data() / folder)) {
      const BodyFrame frame = guess(clip_from_bvh(read_bvh(path)));
      EXPECT_EQ(frame.metres_per_unit, 0.01) << path;
      EXPECT_TRUE(frame.to_y_up.isApprox(Eigen::Quaterniond::Identity())) << path;
      EXPECT_TRUE(frame.warnings.empty()) << path << frame.warnings.front();
      ++clips;
    }
  EXPECT_EQ(clips, 142);
}

TEST(BodyFrame, a_captured_walk_turned_to_z_up_in_inches_is_the_same_walk) {
  GAIT_NEEDS_SHARED_DATA("cmu-walks");
  const Clip clip = clip_from_bvh(read_bvh(testing::shared_data() / "cmu-walks/16_15.bvh"));
  const Clip ours = in_metres_y_up(clip, guess(clip));
  const Clip turned =
      seen_from(ours, Eigen::Quaterniond(std::sqrt(0.5), std::sqrt(0.5), 0, 0), 39.37007874);
  const BodyFrame frame = guess(turned);
  EXPECT_EQ(frame.metres_per_unit, 0.0254);
  EXPECT_TRUE(frame.warnings.empty());
  EXPECT_LT(largest_difference(ours, in_metres_y_up(turned, frame)), 1e-6);
}

}  // namespace
}  // namespace gait
