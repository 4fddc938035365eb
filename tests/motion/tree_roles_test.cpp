// Rigs whose names say nothing: roles from the lengths and places of chains.
#include <gtest/gtest.h>

#include "gait/corpus/corpus.h"
#include "gait/motion/body_frame.h"
#include "gait/motion/joint_roles.h"
#include "gait/motion/rotation.h"

namespace gait {
namespace {

Clip walk() { return make_speed_walks(1, 30)[3].clip; }

void expect_same_roles(const Clip& named, const Clip& nameless, const std::string& what) {
  const JointRoles wanted = find_roles(named), found = find_roles(nameless);
  EXPECT_TRUE(found.has_legs()) << what;
  EXPECT_EQ(found.hips, wanted.hips) << what;
  for (int joint = 0; joint < named.skeleton.size(); ++joint)
    EXPECT_EQ(role_name(found.of_joint[joint]), role_name(wanted.of_joint[joint]))
        << what << ": " << named.skeleton.joints[joint].name;
}

Clip without_names(Clip clip) {
  int number = 0;
  for (Joint& joint : clip.skeleton.joints) joint.name = "Bone." + std::to_string(number++);
  return clip;
}

TEST(TreeRoles, a_walker_without_names_is_understood) {
  const Clip named = walk();
  expect_same_roles(named, without_names(named), "as it is");
}

TEST(TreeRoles, whatever_points_up) {
  const Clip named = walk();
  for (const char up : {'x', 'z'}) {
    BodyFrame frame;
    frame.metres_per_unit = 0.01;
    frame.to_y_up = turn_between(up == 'x' ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ(),
                                 Eigen::Vector3d::UnitY())
                        .conjugate();
    expect_same_roles(named, without_names(in_metres_y_up(named, frame)), std::string(1, up));
  }
}

TEST(TreeRoles, whichever_way_it_walks) {
  const Clip named = walk();
  for (const double heading : {1.0, 3.1, -2.0}) {
    BodyFrame frame;
    frame.to_y_up = about_vertical(heading);
    expect_same_roles(named, without_names(in_metres_y_up(named, frame)), "turned");
  }
}

TEST(TreeRoles, at_rest_without_frames) {
  Clip named = walk();
  named.resize(0);
  expect_same_roles(named, without_names(named), "at rest");
}

TEST(TreeRoles, from_the_motion_where_all_bones_rest_along_one_axis) {
  // As 3ds Max's bones do: each along its own X axis.
  Clip named = walk();
  std::vector<Eigen::Quaterniond> turns(named.skeleton.joints.size(),
                                        Eigen::Quaterniond::Identity());
  const std::vector<Joint> before = named.skeleton.joints;
  for (int joint = 0; joint < named.skeleton.size(); ++joint) {
    Eigen::Vector3d bone = Eigen::Vector3d::Zero();
    int children = 0;
    for (const Joint& child : before)
      if (child.parent == joint) bone = child.offset, ++children;
    if (children == 1 && bone.norm() > 0)
      turns[joint] = turn_between(Eigen::Vector3d::UnitX(), bone.normalized());
  }
  for (int joint = 0; joint < named.skeleton.size(); ++joint) {
    Joint& one = named.skeleton.joints[joint];
    const Eigen::Quaterniond above =
        one.parent < 0 ? Eigen::Quaterniond::Identity() : turns[one.parent].conjugate();
    one.offset = above * one.offset;
    for (Eigen::Vector3d& tip : one.tips) tip = turns[joint].conjugate() * tip;
    for (int t = 0; t < named.frames(); ++t) {
      named.translation(t)[joint] = above * named.translation(t)[joint];
      named.pose(t)[joint] = above * named.pose(t)[joint] * turns[joint];
    }
  }
  expect_same_roles(named, without_names(named), "bones along X");
}

TEST(TreeRoles, names_say_the_sides_where_they_can) {
  Clip named = walk();
  Clip sided = named;
  for (Joint& joint : sided.skeleton.joints) {
    const bool left = joint.name.starts_with("Left"), right = joint.name.starts_with("Right");
    joint.name = std::string(left    ? "links"
                             : right ? "rechts"
                                     : "mitte") +
                 "_" + std::to_string(&joint - sided.skeleton.joints.data());
  }
  expect_same_roles(named, sided, "sides alone");
}

TEST(TreeRoles, one_limb_of_a_strange_name_is_found_beside_the_others) {
  const Clip named = walk();
  for (const char* strange :
       {"LeftUpLeg", "RightLeg", "RightFoot", "LeftArm", "RightForeArm", "Head", "Hips"}) {
    Clip one = named;
    one.skeleton.joints[one.skeleton.find(strange)].name = "Xyz";
    expect_same_roles(named, one, strange);
  }
}

TEST(TreeRoles, what_is_no_body_has_no_legs) {
  Clip crane;
  for (int joint = 0; joint < 6; ++joint)
    crane.skeleton.joints.push_back({"J" + std::to_string(joint), joint - 1, {0, 1, 0}});
  crane.resize(3);
  EXPECT_FALSE(find_roles(crane).has_legs());
  EXPECT_EQ(missing_roles(find_roles(crane)).substr(0, 4), "hips");
}

TEST(TreeRoles, a_written_table_reads_back_as_the_same_roles) {
  const Clip clip = without_names(walk());
  const JointRoles roles = find_roles(clip);
  const RoleTable table = parse_role_table(role_table_text(clip.skeleton, roles), "written");
  EXPECT_EQ(find_roles(clip, table).of_joint, roles.of_joint);
  EXPECT_EQ(find_roles(clip, table).from[roles.hips], RoleSource::table);
}

}  // namespace
}  // namespace gait
