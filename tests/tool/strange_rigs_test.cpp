// Rigs that people really have: bones in position channels, roots that are not the hips, names of
// other programs. Each gives a whole body on the ground.
#include <gtest/gtest.h>

#include <filesystem>

#include "gait/files/bvh.h"
#include "gait/model/body_motion.h"
#include "gait/model/model_file.h"
#include "gait/motion/body_form.h"
#include "gait/motion/humanoid_body.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"
#include "tool_runner.h"
#include "walking_takes.h"

namespace gait::testing {
namespace {

std::string rig(const std::string& name) {
  return (std::filesystem::path(GAIT_TEST_CASES) / (name + ".bvh")).string();
}

// What a walk looks like, whatever its tree.
struct Seen {
  Clip clip;  // in body form
  JointRoles roles;
  double way = 0;                  // of the hips, metres
  double lowest = 0, highest = 0;  // the lower foot's lowest point per frame: of all frames
  double leg = 0;

  explicit Seen(const std::string& path) {
    clip = body_form(clip_from_bvh(read_bvh(path))).clip;
    roles = find_roles(clip);
    EXPECT_TRUE(roles.has_legs()) << path;
    leg = leg_length(clip.skeleton, roles);
    const WorldPoses world = world_poses(clip);
    const auto at = [&](int frame, int joint) {
      return static_cast<std::size_t>(frame) * clip.skeleton.joints.size() + joint;
    };
    const int last = clip.frames() - 1;
    Eigen::Vector3d travel =
        world.positions[at(last, roles.hips)] - world.positions[at(0, roles.hips)];
    travel.y() = 0;
    way = travel.norm();
    lowest = 1e9, highest = -1e9;
    for (int frame = 0; frame <= last; ++frame) {
      double low = 1e9;
      for (int joint = 0; joint < clip.skeleton.size(); ++joint)
        if (roles.in_leg[joint])
          for (const Eigen::Vector3d& tip : clip.skeleton.joints[joint].tips)
            low = std::min(
                low,
                (world.positions[at(frame, joint)] + world.rotations[at(frame, joint)] * tip).y());
      lowest = std::min(lowest, low), highest = std::max(highest, low);
    }
  }
};

void expect_on_the_ground(const Seen& seen, const std::string& what) {
  EXPECT_GT(seen.lowest, -0.06) << what;
  EXPECT_LT(seen.highest, 0.08) << what;
}

TEST(StrangeRigs, reconstruct_gives_a_whole_body_that_travels) {
  const TestFolder folder;
  for (const char* name : {"offsets-in-channels", "armature-root-hips"}) {
    const ToolRun run = run_tool({"reconstruct", "gait-demo", rig(name), "-o", folder / "out.bvh"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Seen made(folder / "out.bvh"), truth(rig(name));
    EXPECT_NEAR(made.way / truth.way, 1, 0.05) << name;
    EXPECT_NEAR(made.leg, 0.83, 0.01) << name;
    expect_on_the_ground(made, name);
    const ToolRun kept = run_tool(
        {"reconstruct", "gait-demo", rig(name), "-o", folder / "out.bvh", "--root", "keep"});
    ASSERT_EQ(kept.exit_code, 0) << kept.err;
    EXPECT_NEAR(Seen(folder / "out.bvh").way, truth.way, 0.02) << name;
  }
}

TEST(StrangeRigs, what_is_measured_above_the_hips_stays) {
  const TestFolder folder;
  const ToolRun train = train_quickly({rig("root-at-head")}, folder / "m.gait");
  ASSERT_EQ(train.exit_code, 0) << train.err;
  for (const std::string root : {"feet", "keep"}) {
    const ToolRun run = run_tool({"reconstruct", folder / "m.gait", rig("root-at-head"), "-o",
                                  folder / "out.bvh", "--root", root});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const BvhFile before = read_bvh(rig("root-at-head")), after = read_bvh(folder / "out.bvh");
    ASSERT_EQ(after.values.cols(), before.values.cols());
    // HMD (six channels), Head, Neck, Chest, Waist.
    const Eigen::Index measured = 6 + 4 * 3, first = root == "feet" ? 3 : 0;
    EXPECT_EQ(after.values.middleCols(first, measured - first),
              before.values.middleCols(first, measured - first));
    for (int joint = 0; joint < before.skeleton.size(); ++joint)
      EXPECT_EQ(after.skeleton.joints[joint].name, before.skeleton.joints[joint].name);
    const Seen made(folder / "out.bvh"), truth(rig("root-at-head"));
    EXPECT_NEAR(made.way / truth.way, 1, 0.05) << root;
    expect_on_the_ground(made, root);
  }
}

// As [gait.bvh] reads a clip to play it.
TEST(StrangeRigs, clips_are_played_on_the_body_that_was_learnt_from_them) {
  const TestFolder folder;
  for (const char* name : {"offsets-in-channels", "root-at-head", "armature-root-hips"}) {
    const ToolRun train = train_quickly({rig(name)}, folder / "m.gait");
    ASSERT_EQ(train.exit_code, 0) << train.err;
    const BodyMotion motion = read_motion(rig(name), read_model(folder / "m.gait"));
    EXPECT_TRUE(motion.warnings.empty()) << motion.warnings[0];
    EXPECT_NEAR((motion.hips.back() - motion.hips.front()).norm(), 5.7, 0.05) << name;
    EXPECT_EQ(motion.contacts.size(), 7u) << name;
  }
}

TEST(StrangeRigs, learnt_walks_keep_trunk_and_legs_together) {
  const TestFolder folder;
  for (const char* name : {"offsets-in-channels", "root-at-head"}) {
    const ToolRun train = train_quickly({rig(name)}, folder / "m.gait", {"--label", "{style}.bvh"});
    ASSERT_EQ(train.exit_code, 0) << train.err;
    const ToolRun synth = run_tool(
        {"synth", folder / "m.gait", "--style", name, "--seconds", "5", "-o", folder / "out.bvh"});
    ASSERT_EQ(synth.exit_code, 0) << synth.err;
    const Seen made(folder / "out.bvh");
    EXPECT_NEAR(made.leg, 0.83, 0.01) << name;
    EXPECT_GT(made.way, 3) << name;
    expect_on_the_ground(made, name);
    const WorldPoses world = world_poses(made.clip);
    const int head = made.roles.joint(Role::head);
    ASSERT_GE(head, 0) << name;
    for (int frame = 0; frame < made.clip.frames(); ++frame) {
      const auto row = static_cast<std::size_t>(frame) * made.clip.skeleton.joints.size();
      const Eigen::Vector3d up =
          world.positions[row + head] - world.positions[row + made.roles.hips];
      EXPECT_GT(up.y(), 0.35) << name;
      EXPECT_LT(up.norm(), 0.7) << name;
    }
  }
}

// The directions of arms and legs as an avatar gets them.
TEST(StrangeRigs, an_avatar_gets_the_clips_own_limbs) {
  const std::vector<std::array<Role, 2>> limbs{{Role::left_arm, Role::left_forearm},
                                               {Role::right_arm, Role::right_forearm},
                                               {Role::left_thigh, Role::left_shank},
                                               {Role::right_shank, Role::right_foot}};
  for (const char* name : {"offsets-in-channels", "root-at-head", "armature-root-hips",
                           "poser-arms", "names-jnt", "avatar-names"}) {
    const Seen seen(rig(name));
    const Skeleton& skeleton = seen.clip.skeleton;
    const HumanoidBody body(skeleton, seen.roles, usual_pose(seen.clip, seen.roles));
    const WorldPoses world = world_poses(seen.clip);
    const auto joints = skeleton.joints.size();
    HumanoidPose pose;
    for (int frame = 0; frame < seen.clip.frames(); frame += 5) {
      const auto row = static_cast<std::size_t>(frame) * joints;
      body.read({world.rotations.data() + row, joints}, {world.positions.data() + row, joints},
                pose);
      for (const auto& [from, to] : limbs) {
        const int upper = seen.roles.joint(from), lower = seen.roles.joint(to);
        ASSERT_TRUE(upper >= 0 && lower >= 0) << name << " " << role_name(from);
        int bone = 0;
        while (bone < main_bones && body.joints()[upper].bone != bone) ++bone;
        ASSERT_TRUE(pose.turned[bone]) << name << " " << role_name(from);
        const bool leg = from >= Role::left_thigh;
        const double side = from < Role::right_shoulder ? 1 : -1;
        const Eigen::Vector3d rest = leg ? Eigen::Vector3d(0, -1, 0) : Eigen::Vector3d(side, 0, 0);
        const Eigen::Vector3d is = pose.turns[bone] * rest;
        const Eigen::Vector3d was =
            (world.positions[row + lower] - world.positions[row + upper]).normalized();
        EXPECT_LT(std::acos(std::min(1.0, is.dot(was))) * 57.3, 1)
            << name << " " << role_name(from);
      }
    }
  }
}

TEST(StrangeRigs, names_with_anything_added_are_labelled_without_a_word) {
  for (const char* name : {"names-jnt", "poser-arms", "avatar-names", "offsets-in-channels",
                           "root-at-head", "armature-root-hips"}) {
    const ToolRun run = run_tool({"label", rig(name)});
    EXPECT_EQ(run.exit_code, 0) << name;
    EXPECT_EQ(run.err, "") << name;
  }
}

TEST(StrangeRigs, roles_shows_what_is_understood_and_writes_it) {
  const TestFolder folder;
  const ToolRun run = run_tool({"roles", rig("names-jnt"), "-o", folder / "roles.txt"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("l_upleg_JNT"), std::string::npos);
  EXPECT_NE(run.out.find("left thigh"), std::string::npos);
  const RoleTable table = read_role_table(folder / "roles.txt");
  EXPECT_EQ(table.at("l_upleg_JNT"), Role::left_thigh);
  EXPECT_EQ(run_tool({"label", rig("names-jnt"), "--roles", folder / "roles.txt"}).out,
            run_tool({"label", rig("names-jnt")}).out);
  const ToolRun json = run_tool({"roles", rig("root-at-head"), "--json"});
  EXPECT_NE(json.out.find("\"root_turned_over\": true"), std::string::npos) << json.out;
}

TEST(StrangeRigs, a_role_file_of_a_re_rooted_clip_means_the_same_again) {
  const TestFolder folder;
  ASSERT_EQ(run_tool({"roles", rig("root-at-head"), "-o", folder / "roles.txt"}).exit_code, 0);
  const ToolRun again = run_tool({"roles", rig("root-at-head"), "--roles", folder / "roles.txt"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(run_tool({"roles", rig("root-at-head"), "--roles", folder / "roles.txt", "-o",
                      folder / "again.txt"})
                .exit_code,
            0);
  EXPECT_EQ(bytes_of(folder / "again.txt"), bytes_of(folder / "roles.txt"));
}

TEST(StrangeRigs, what_is_not_understood_is_said_first) {
  const TestFolder folder;
  BvhFile file = read_bvh(rig("names-jnt"));
  file.skeleton.joints.resize(6);  // trunk and head
  file.channels.resize(6);
  file.values.conservativeResize(Eigen::NoChange, 6 + 5 * 3);
  write_bvh(file, folder / "half.bvh");
  const ToolRun run = run_tool({"roles", folder / "half.bvh"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LT(run.err.find("no joint is understood as"), run.err.find("--unit")) << run.err;
}

}  // namespace
}  // namespace gait::testing
