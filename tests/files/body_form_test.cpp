// Files whose bones are in position channels, and files whose root is not the hips.
#include "gait/motion/body_form.h"

#include <gtest/gtest.h>

#include "gait/corpus/corpus.h"
#include "gait/files/bvh.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"

namespace gait {
namespace {

Clip case_clip(const std::string& name) {
  return clip_from_bvh(read_bvh(std::filesystem::path(GAIT_TEST_CASES) / (name + ".bvh")));
}

double leg_of(const Clip& clip) { return leg_length(clip.skeleton, find_roles(clip)); }

const Eigen::Vector3d& place(const WorldPoses& world, const Clip& clip, int frame, int joint) {
  return world.positions[static_cast<std::size_t>(frame) * clip.skeleton.joints.size() + joint];
}

// All ends of bones are where they were, and all joints are turned as they were.
void expect_same_body(const Clip& before, const BodyForm& form) {
  const Clip& after = form.clip;
  const WorldPoses old_world = world_poses(before), new_world = world_poses(after);
  ASSERT_EQ(after.frames(), before.frames());
  for (int frame = 0; frame < before.frames(); frame += 10)
    for (int joint = 0; joint < after.skeleton.size(); ++joint) {
      const int old = form.joint_in_file[joint];
      const auto row = static_cast<std::size_t>(frame) * before.skeleton.joints.size();
      EXPECT_LT(angle_between(new_world.rotations[row + joint], old_world.rotations[row + old]),
                1e-6);
      const int place_of = is_turned_over(after.skeleton.joints[joint]) ? -1 : old;
      if (place_of >= 0) {
        EXPECT_LT(
            (place(new_world, after, frame, joint) - place(old_world, before, frame, old)).norm(),
            1e-9)
            << after.skeleton.joints[joint].name;
      }
    }
}

TEST(BodyForm, bones_are_what_positions_say) {
  const BodyForm form = body_form(case_clip("offsets-in-channels"));
  EXPECT_NEAR(leg_of(form.clip), 0.83, 1e-3);
  EXPECT_TRUE(form.warnings.empty());
  EXPECT_FALSE(form.re_rooted);
}

TEST(BodyForm, positions_of_zero_are_added_to_offsets) {
  Clip clip = make_speed_walks(1, 30)[3].clip;
  const Clip before = clip;
  for (int frame = 0; frame < clip.frames(); ++frame)
    for (int joint = 1; joint < clip.skeleton.size(); ++joint)
      clip.translation(frame)[joint].setZero();
  const BodyForm form = body_form(clip);
  EXPECT_EQ(form.clip.translations, before.translations);
  EXPECT_TRUE(form.adds_to_offset[clip.skeleton.find("LeftLeg")]);
  EXPECT_DOUBLE_EQ(leg_of(form.clip), leg_of(before));
}

TEST(BodyForm, positions_count_against_other_offsets) {
  Clip clip = make_speed_walks(1, 30)[3].clip;
  const double leg = leg_of(clip);
  for (Joint& joint : clip.skeleton.joints)
    if (joint.parent >= 0) joint.offset *= 1.3;
  EXPECT_NEAR(leg_of(body_form(clip).clip), leg, 1e-9);
}

TEST(BodyForm, joints_that_stretch_are_read_and_said) {
  Clip clip = make_speed_walks(1, 30)[3].clip;
  const double leg = leg_of(clip);
  const int shank = clip.skeleton.find("LeftLeg");
  for (int frame = 0; frame < clip.frames(); ++frame)
    clip.translation(frame)[shank] *= 1 + 0.1 * std::sin(frame * 0.4);
  const BodyForm form = body_form(clip);
  ASSERT_EQ(form.warnings.size(), 1u);
  EXPECT_NE(form.warnings[0].find("LeftLeg"), std::string::npos) << form.warnings[0];
  EXPECT_NEAR(leg_of(form.clip), leg, 0.02 * leg);
  EXPECT_EQ(form.clip.translations, clip.translations);
}

TEST(BodyForm, a_usual_clip_stays_as_it_is) {
  const Clip clip = make_speed_walks(1, 30)[3].clip;
  const BodyForm form = body_form(clip);
  EXPECT_FALSE(form.re_rooted);
  EXPECT_EQ(form.clip.translations, clip.translations);
  for (int joint = 0; joint < clip.skeleton.size(); ++joint)
    EXPECT_EQ(form.clip.skeleton.joints[joint].offset, clip.skeleton.joints[joint].offset);
}

TEST(BodyForm, a_body_below_its_head_hangs_on_the_hips) {
  const Clip before = case_clip("root-at-head");
  const BodyForm form = body_form(before);
  ASSERT_TRUE(form.re_rooted);
  const Skeleton& skeleton = form.clip.skeleton;
  const JointRoles roles = find_roles(form.clip);
  EXPECT_EQ(roles.hips, 0);
  EXPECT_EQ(skeleton.joints[0].name, "Hip");
  // A joint turns the bone below it: the one named Head is at the neck.
  EXPECT_EQ(roles.of_joint[skeleton.find("HMD")], Role::head);
  EXPECT_EQ(roles.of_joint[skeleton.find("Head")], Role::neck);
  for (const char* spine : {"Neck", "Chest", "Waist"})
    EXPECT_EQ(roles.of_joint[skeleton.find(spine)], Role::spine) << spine;
  EXPECT_EQ(roles.of_joint[skeleton.find("Left-UpperArm")], Role::left_arm);
  expect_same_body(before, form);
  // The joints of the trunk are where they were, each borne by the name of the one above.
  const WorldPoses old_world = world_poses(before), new_world = world_poses(form.clip);
  for (const auto& [now, then] : {std::pair{"HMD", "Head"},
                                  {"Head", "Neck"},
                                  {"Neck", "Chest"},
                                  {"Chest", "Waist"},
                                  {"Waist", "Hip"}})
    for (int frame = 0; frame < before.frames(); frame += 10)
      EXPECT_LT((place(new_world, form.clip, frame, skeleton.find(now)) -
                 place(old_world, before, frame, before.skeleton.find(then)))
                    .norm(),
                1e-9)
          << now;
  // What was turned over onto the hips is an output as they are.
  EXPECT_EQ(roles.hips_and_legs().size(), 8u);
}

// A clip on the tree whose root is `root`: the other way round.
Clip rooted_at(const Clip& clip, int root) {
  JointRoles none;
  Clip result = clip;
  const WorldPoses world = world_poses(clip);
  const auto joints = static_cast<std::size_t>(clip.skeleton.size());
  std::vector<int> chain;
  for (int at = root; at >= 0; at = clip.skeleton.joints[at].parent) chain.push_back(at);
  // A joint above the root in the clip gets the frame of its bone towards the root.
  std::vector<int> frame_of(joints), parent(joints);
  for (std::size_t i = 0; i < joints; ++i)
    frame_of[i] = static_cast<int>(i), parent[i] = clip.skeleton.joints[i].parent;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    frame_of[chain[i]] = chain[i + 1];
    parent[chain[i + 1]] = chain[i];
  }
  parent[root] = -1;
  std::vector<int> order{root}, in_order(joints, -1);
  for (std::size_t i = 0; i < order.size(); ++i) {
    in_order[order[i]] = static_cast<int>(i);
    for (std::size_t j = 0; j < joints; ++j)
      if (parent[j] == order[i]) order.push_back(static_cast<int>(j));
  }
  result.skeleton.joints.clear();
  for (const int joint : order) {
    Joint made = clip.skeleton.joints[joint];
    made.parent = parent[joint] < 0 ? -1 : in_order[parent[joint]];
    result.skeleton.joints.push_back(made);
  }
  for (int t = 0; t < clip.frames(); ++t)
    for (std::size_t i = 0; i < joints; ++i) {
      const int joint = order[i], up = parent[joint];
      const auto row = static_cast<std::size_t>(t) * joints;
      const Eigen::Quaterniond turned = world.rotations[row + frame_of[joint]];
      const Eigen::Vector3d at = world.positions[row + joint];
      const Eigen::Quaterniond above =
          up < 0 ? Eigen::Quaterniond::Identity() : world.rotations[row + frame_of[up]];
      result.pose(t)[i] = above.conjugate() * turned;
      result.translation(t)[i] =
          above.conjugate() * (up < 0 ? at : Eigen::Vector3d(at - world.positions[row + up]));
      if (t == 0 && up >= 0) result.skeleton.joints[i].offset = result.translation(0)[i];
    }
  return result;
}

TEST(BodyForm, wherever_the_root_is_the_hips_and_legs_are_the_same) {
  const Clip walk = make_speed_walks(1, 30)[3].clip;
  const JointRoles wanted = find_roles(walk);
  const WorldPoses truth = world_poses(walk);
  for (const char* root : {"Head", "Neck", "Spine2", "Spine1", "LeftArm", "RightForeArm"}) {
    const BodyForm form = body_form(rooted_at(walk, walk.skeleton.find(root)));
    ASSERT_TRUE(form.re_rooted) << root;
    const JointRoles roles = find_roles(form.clip);
    ASSERT_TRUE(roles.has_legs()) << root;
    EXPECT_EQ(roles.hips, 0) << root;
    const WorldPoses world = world_poses(form.clip);
    for (const Role role : {Role::hips, Role::left_thigh, Role::right_shank, Role::left_foot})
      for (int frame = 0; frame < walk.frames(); frame += 20)
        EXPECT_LT((place(world, form.clip, frame, roles.joint(role)) -
                   place(truth, walk, frame, wanted.joint(role)))
                      .norm(),
                  1e-9)
            << root << " " << role_name(role);
  }
}

TEST(BodyForm, fixed_parents_above_the_hips_stay) {
  const Clip clip = case_clip("armature-root-hips");
  const BodyForm form = body_form(clip);
  EXPECT_FALSE(form.re_rooted);
  EXPECT_EQ(find_roles(form.clip).hips, clip.skeleton.find("Hips"));
}

TEST(BodyForm, a_trunk_beside_the_pelvis_hangs_on_it) {
  // As in MMD: legs below the lower body, trunk below the upper one, both on the centre.
  Clip clip = make_speed_walks(1, 30)[3].clip;
  Clip mmd = clip;
  for (Joint& joint : mmd.skeleton.joints) joint.parent += joint.parent >= 0 ? 1 : 1;
  mmd.skeleton.joints.insert(mmd.skeleton.joints.begin(), clip.skeleton.joints[0]);
  mmd.skeleton.joints[0].name = "Root";
  mmd.skeleton.joints[1].offset.setZero();
  mmd.skeleton.joints[mmd.skeleton.find("Spine")].parent = 0;
  mmd.rotations.clear(), mmd.translations.clear();
  for (int frame = 0; frame < clip.frames(); ++frame) {
    // The root only carries; hips and spine both turn against it.
    mmd.rotations.push_back(Eigen::Quaterniond::Identity());
    mmd.translations.push_back(clip.translation(frame)[0]);
    for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
      const bool spine = clip.skeleton.joints[joint].name == "Spine";
      mmd.rotations.push_back(spine ? clip.pose(frame)[0] * clip.pose(frame)[joint]
                                    : clip.pose(frame)[joint]);
      mmd.translations.push_back(joint == 0 ? Eigen::Vector3d(0, 0, 0)
                                            : clip.translation(frame)[joint]);
    }
  }
  const BodyForm form = body_form(mmd);
  EXPECT_TRUE(form.re_rooted);
  const JointRoles roles = find_roles(form.clip);
  EXPECT_EQ(form.clip.skeleton.joints[roles.hips].name, "Hips");
  EXPECT_TRUE(form.clip.skeleton.is_in_branch(roles.joint(Role::head), roles.hips));
  expect_same_body(mmd, form);
}

}  // namespace
}  // namespace gait
