#include "gait/motion/joint_roles.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "files/small_bvh.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "shared_data.h"

namespace gait {
namespace {

// A rig as text: "Hips(Spine(Head) LeftUpLeg(LeftLeg))"; names end at a bracket or a space.
Skeleton rig(std::string_view text) {
  Skeleton skeleton;
  std::vector<int> above{-1};
  int last = -1;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '(') {
      above.push_back(last);
    } else if (text[i] == ')') {
      above.pop_back();
    } else if (text[i] != ' ') {
      const std::size_t end = std::min(text.find_first_of("() ", i), text.size());
      std::string name(text.substr(i, end - i));
      for (char& c : name)
        if (c == '~') c = ' ';  // stands for a space in a name
      skeleton.joints.push_back({name, above.back(), {0, 0, 0}, {}});
      last = skeleton.size() - 1;
      i = end;
      continue;
    }
    ++i;
  }
  return skeleton;
}

struct Expected {
  const char* maker;
  const char* rig;
  // hips, thighs, shanks, feet, toes, head, shoulders, arms, forearms, hands; "-": there is none
  std::array<const char*, 19> names;
};

constexpr std::array<Role, 19> order{
    Role::hips,           Role::left_thigh, Role::right_thigh, Role::left_shank,
    Role::right_shank,    Role::left_foot,  Role::right_foot,  Role::left_toes,
    Role::right_toes,     Role::neck,       Role::head,        Role::left_shoulder,
    Role::right_shoulder, Role::left_arm,   Role::right_arm,   Role::left_forearm,
    Role::right_forearm,  Role::left_hand,  Role::right_hand};

const std::vector<Expected> rigs{
    {"Bandai-Namco",
     "joint_Root(Hips(Spine(Chest(Neck(Head) Shoulder_L(UpperArm_L(LowerArm_L(Hand_L))) "
     "Shoulder_R(UpperArm_R(LowerArm_R(Hand_R))))) UpperLeg_L(LowerLeg_L(Foot_L(Toes_L))) "
     "UpperLeg_R(LowerLeg_R(Foot_R(Toes_R)))))",
     {"Hips", "UpperLeg_L", "UpperLeg_R", "LowerLeg_L", "LowerLeg_R", "Foot_L", "Foot_R", "Toes_L",
      "Toes_R", "Neck", "Head", "Shoulder_L", "Shoulder_R", "UpperArm_L", "UpperArm_R",
      "LowerArm_L", "LowerArm_R", "Hand_L", "Hand_R"}},
    {"CMU",
     "Hips(LHipJoint(LeftUpLeg(LeftLeg(LeftFoot(LeftToeBase)))) "
     "RHipJoint(RightUpLeg(RightLeg(RightFoot(RightToeBase)))) LowerBack(Spine(Spine1(Neck("
     "Neck1(Head)) LeftShoulder(LeftArm(LeftForeArm(LeftHand(lhand(lfingers) lthumb)))) "
     "RightShoulder(RightArm(RightForeArm(RightHand(rhand(rfingers) rthumb))))))))",
     {"Hips", "LeftUpLeg", "RightUpLeg", "LeftLeg", "RightLeg", "LeftFoot", "RightFoot",
      "LeftToeBase", "RightToeBase", "Neck", "Head", "LeftShoulder", "RightShoulder", "LeftArm",
      "RightArm", "LeftForeArm", "RightForeArm", "LeftHand", "RightHand"}},
    {"CMU's own skeletons",
     "root(lhipjoint(lfemur(ltibia(lfoot(ltoes)))) rhipjoint(rfemur(rtibia(rfoot(rtoes)))) "
     "lowerback(upperback(thorax(lowerneck(upperneck(head)) lclavicle(lhumerus(lradius(lwrist("
     "lhand(lfingers) lthumb)))) rclavicle(rhumerus(rradius(rwrist(rhand(rfingers) rthumb))))))))",
     {"root", "lfemur", "rfemur", "ltibia", "rtibia", "lfoot", "rfoot", "ltoes", "rtoes",
      "lowerneck", "head", "lclavicle", "rclavicle", "lhumerus", "rhumerus", "lradius", "rradius",
      "lwrist", "rwrist"}},
    {"Mixamo",
     "mixamorig:Hips(mixamorig:Spine(mixamorig:Spine1(mixamorig:Spine2(mixamorig:Neck("
     "mixamorig:Head(mixamorig:HeadTop_End mixamorig:LeftEye)) mixamorig:LeftShoulder("
     "mixamorig:LeftArm(mixamorig:LeftForeArm(mixamorig:LeftHand(mixamorig:LeftHandThumb1 "
     "mixamorig:LeftHandIndex1)))) mixamorig:RightShoulder(mixamorig:RightArm("
     "mixamorig:RightForeArm(mixamorig:RightHand)))))) mixamorig:RightUpLeg(mixamorig:RightLeg("
     "mixamorig:RightFoot(mixamorig:RightToeBase(mixamorig:RightToe_End)))) mixamorig:LeftUpLeg("
     "mixamorig:LeftLeg(mixamorig:LeftFoot(mixamorig:LeftToeBase(mixamorig:LeftToe_End)))))",
     {"mixamorig:Hips", "mixamorig:LeftUpLeg", "mixamorig:RightUpLeg", "mixamorig:LeftLeg",
      "mixamorig:RightLeg", "mixamorig:LeftFoot", "mixamorig:RightFoot", "mixamorig:LeftToeBase",
      "mixamorig:RightToeBase", "mixamorig:Neck", "mixamorig:Head", "mixamorig:LeftShoulder",
      "mixamorig:RightShoulder", "mixamorig:LeftArm", "mixamorig:RightArm", "mixamorig:LeftForeArm",
      "mixamorig:RightForeArm", "mixamorig:LeftHand", "mixamorig:RightHand"}},
    {"Xsens",
     "Pelvis(L5(L3(T12(T8(Neck(Head) RightShoulder(RightUpperArm(RightForeArm(RightHand))) "
     "LeftShoulder(LeftUpperArm(LeftForeArm(LeftHand))))))) RightUpperLeg(RightLowerLeg("
     "RightFoot(RightToe))) LeftUpperLeg(LeftLowerLeg(LeftFoot(LeftToe))))",
     {"Pelvis", "LeftUpperLeg", "RightUpperLeg", "LeftLowerLeg", "RightLowerLeg", "LeftFoot",
      "RightFoot", "LeftToe", "RightToe", "Neck", "Head", "LeftShoulder", "RightShoulder",
      "LeftUpperArm", "RightUpperArm", "LeftForeArm", "RightForeArm", "LeftHand", "RightHand"}},
    {"joints named after joints (Xsens' BVH, MocapBank)",
     "Hips(Chest(Chest2(LeftCollar(LeftShoulder(LeftElbow(LeftWrist))) RightCollar(RightShoulder("
     "RightElbow(RightWrist))) Neck(Head))) LeftHip(LeftKnee(LeftAnkle(LeftToe))) RightHip("
     "RightKnee(RightAnkle(RightToe))))",
     {"Hips", "LeftHip", "RightHip", "LeftKnee", "RightKnee", "LeftAnkle", "RightAnkle", "LeftToe",
      "RightToe", "Neck", "Head", "LeftCollar", "RightCollar", "LeftShoulder", "RightShoulder",
      "LeftElbow", "RightElbow", "LeftWrist", "RightWrist"}},
    {"Perception Neuron",
     "Robot_Hips(Robot_RightUpLeg(Robot_RightLeg(Robot_RightFoot)) Robot_LeftUpLeg("
     "Robot_LeftLeg(Robot_LeftFoot)) Robot_Spine(Robot_Spine1(Robot_Neck(Robot_Head) "
     "Robot_RightShoulder(Robot_RightArm(Robot_RightForeArm(Robot_RightHand("
     "Robot_RightHandThumb1 Robot_RightInHandIndex(Robot_RightHandIndex1))))) Robot_LeftShoulder("
     "Robot_LeftArm(Robot_LeftForeArm(Robot_LeftHand(Robot_LeftHandThumb1)))))))",
     {"Robot_Hips", "Robot_LeftUpLeg", "Robot_RightUpLeg", "Robot_LeftLeg", "Robot_RightLeg",
      "Robot_LeftFoot", "Robot_RightFoot", "-", "-", "Robot_Neck", "Robot_Head",
      "Robot_LeftShoulder", "Robot_RightShoulder", "Robot_LeftArm", "Robot_RightArm",
      "Robot_LeftForeArm", "Robot_RightForeArm", "Robot_LeftHand", "Robot_RightHand"}},
    {"VRM, Unity",
     "hips(spine(chest(upperChest(neck(head(leftEye jaw)) leftShoulder(leftUpperArm(leftLowerArm("
     "leftHand(leftThumbProximal leftIndexProximal)))) rightShoulder(rightUpperArm(rightLowerArm("
     "rightHand)))))) leftUpperLeg(leftLowerLeg(leftFoot(leftToes))) rightUpperLeg("
     "rightLowerLeg(rightFoot(rightToes))))",
     {"hips", "leftUpperLeg", "rightUpperLeg", "leftLowerLeg", "rightLowerLeg", "leftFoot",
      "rightFoot", "leftToes", "rightToes", "neck", "head", "leftShoulder", "rightShoulder",
      "leftUpperArm", "rightUpperArm", "leftLowerArm", "rightLowerArm", "leftHand", "rightHand"}},
    {"VRoid",
     "Root(J_Bip_C_Hips(J_Bip_C_Spine(J_Bip_C_Chest(J_Bip_C_UpperChest(J_Bip_C_Neck("
     "J_Bip_C_Head(J_Sec_Hair1_01)) J_Bip_L_Shoulder(J_Bip_L_UpperArm(J_Bip_L_LowerArm("
     "J_Bip_L_Hand(J_Bip_L_Index1)))) J_Bip_R_Shoulder(J_Bip_R_UpperArm(J_Bip_R_LowerArm("
     "J_Bip_R_Hand)))))) J_Bip_L_UpperLeg(J_Bip_L_LowerLeg(J_Bip_L_Foot(J_Bip_L_ToeBase))) "
     "J_Bip_R_UpperLeg(J_Bip_R_LowerLeg(J_Bip_R_Foot(J_Bip_R_ToeBase)))))",
     {"J_Bip_C_Hips", "J_Bip_L_UpperLeg", "J_Bip_R_UpperLeg", "J_Bip_L_LowerLeg",
      "J_Bip_R_LowerLeg", "J_Bip_L_Foot", "J_Bip_R_Foot", "J_Bip_L_ToeBase", "J_Bip_R_ToeBase",
      "J_Bip_C_Neck", "J_Bip_C_Head", "J_Bip_L_Shoulder", "J_Bip_R_Shoulder", "J_Bip_L_UpperArm",
      "J_Bip_R_UpperArm", "J_Bip_L_LowerArm", "J_Bip_R_LowerArm", "J_Bip_L_Hand", "J_Bip_R_Hand"}},
    {"3ds Max Biped",
     "Bip01(Bip01~Pelvis(Bip01~Spine(Bip01~Neck(Bip01~Head(Bip01~HeadNub) Bip01~L~Clavicle("
     "Bip01~L~UpperArm(Bip01~L~Forearm(Bip01~L~Hand(Bip01~L~Finger0)))) Bip01~R~Clavicle("
     "Bip01~R~UpperArm(Bip01~R~Forearm(Bip01~R~Hand)))) Bip01~L~Thigh(Bip01~L~Calf(Bip01~L~Foot("
     "Bip01~L~Toe0(Bip01~L~Toe0Nub)))) Bip01~R~Thigh(Bip01~R~Calf(Bip01~R~Foot(Bip01~R~Toe0))))))",
     {"Bip01 Pelvis", "Bip01 L Thigh", "Bip01 R Thigh", "Bip01 L Calf", "Bip01 R Calf",
      "Bip01 L Foot", "Bip01 R Foot", "Bip01 L Toe0", "Bip01 R Toe0", "Bip01 Neck", "Bip01 Head",
      "Bip01 L Clavicle", "Bip01 R Clavicle", "Bip01 L UpperArm", "Bip01 R UpperArm",
      "Bip01 L Forearm", "Bip01 R Forearm", "Bip01 L Hand", "Bip01 R Hand"}},
    {"Unreal",
     "root(pelvis(spine_01(spine_02(neck_01(head) clavicle_l(upperarm_l(lowerarm_l(hand_l("
     "index_01_l) lowerarm_twist_01_l))) clavicle_r(upperarm_r(lowerarm_r(hand_r))))) thigh_l("
     "calf_l(foot_l(ball_l)) thigh_twist_01_l) thigh_r(calf_r(foot_r(ball_r)))) ik_foot_root("
     "ik_foot_l ik_foot_r))",
     {"pelvis", "thigh_l", "thigh_r", "calf_l", "calf_r", "foot_l", "foot_r", "ball_l", "ball_r",
      "neck_01", "head", "clavicle_l", "clavicle_r", "upperarm_l", "upperarm_r", "lowerarm_l",
      "lowerarm_r", "hand_l", "hand_r"}},
    {"SMPL",
     "Pelvis(L_Hip(L_Knee(L_Ankle(L_Foot))) R_Hip(R_Knee(R_Ankle(R_Foot))) Spine1(Spine2(Neck("
     "Head) L_Collar(L_Shoulder(L_Elbow(L_Wrist(L_Hand)))) R_Collar(R_Shoulder(R_Elbow(R_Wrist("
     "R_Hand)))))))",
     {"Pelvis", "L_Hip", "R_Hip", "L_Knee", "R_Knee", "L_Ankle", "R_Ankle", "L_Foot", "R_Foot",
      "Neck", "Head", "L_Collar", "R_Collar", "L_Shoulder", "R_Shoulder", "L_Elbow", "R_Elbow",
      "L_Wrist", "R_Wrist"}},
    {"OptiTrack",
     "Hip(Ab(Chest(Neck(Head) LShoulder(LUArm(LFArm(LHand))) RShoulder(RUArm(RFArm(RHand))))) "
     "LThigh(LShin(LFoot(LToe))) RThigh(RShin(RFoot(RToe))))",
     {"Hip", "LThigh", "RThigh", "LShin", "RShin", "LFoot", "RFoot", "LToe", "RToe", "Neck", "Head",
      "LShoulder", "RShoulder", "LUArm", "RUArm", "LFArm", "RFArm", "LHand", "RHand"}},
    {"Kinect",
     "SpineBase(SpineMid(SpineShoulder(Neck(Head) ShoulderLeft(ElbowLeft(WristLeft(HandLeft("
     "HandTipLeft ThumbLeft)))) ShoulderRight(ElbowRight(WristRight(HandRight))))) HipLeft("
     "KneeLeft(AnkleLeft(FootLeft))) HipRight(KneeRight(AnkleRight(FootRight))))",
     {"SpineBase", "HipLeft", "HipRight", "KneeLeft", "KneeRight", "AnkleLeft", "AnkleRight",
      "FootLeft", "FootRight", "Neck", "Head", "-", "-", "ShoulderLeft", "ShoulderRight",
      "ElbowLeft", "ElbowRight", "WristLeft", "WristRight"}},
};

TEST(JointRoles, the_usual_makers_names_are_understood) {
  for (const Expected& expected : rigs) {
    const Skeleton skeleton = rig(expected.rig);
    const JointRoles roles = find_roles(skeleton);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const int joint = roles.joint(order[i]);
      EXPECT_EQ(joint < 0 ? "-" : skeleton.joints[joint].name, expected.names[i])
          << expected.maker << ": " << role_name(order[i]);
    }
    EXPECT_TRUE(roles.has_legs()) << expected.maker;
    EXPECT_EQ(roles.hips, roles.joint(Role::hips));
    EXPECT_EQ(roles.right.toes, roles.joint(Role::right_toes));
    for (int joint = 0; joint < skeleton.size(); ++joint)
      for (const char* none : {"humb", "ndex", "inger", "Eye", "Hair", "Nub", "_End", "ik_", "Tip"})
        if (skeleton.joints[joint].name.find(none) != std::string::npos) {
          EXPECT_EQ(roles.of_joint[joint], Role::none) << skeleton.joints[joint].name;
        }
  }
}

TEST(JointRoles, all_rigs_of_the_captured_walks_have_legs_and_arms) {
  GAIT_NEEDS_SHARED_DATA("bvh-zoo");
  for (const auto& path : testing::bvh_files_below(testing::shared_data())) {
    const std::string name = path.filename().string();
    const bool whole_body =
        name != "full_precision_frame_time.bvh" && name != "rotation_first_root.bvh";
    const JointRoles roles = find_roles(read_bvh(path).skeleton);
    EXPECT_EQ(roles.has_legs(), whole_body) << path;
    for (const Role role : {Role::neck, Role::left_arm, Role::right_forearm, Role::left_hand})
      EXPECT_TRUE(roles.joint(role) >= 0 || !whole_body) << path << " " << role_name(role);
  }
}

TEST(JointRoles, the_body_of_the_mean_gait_is_understood) {
  GAIT_NEEDS_SHARED_DATA("mean-gait.json");
  std::ifstream stream(testing::shared_data() / "mean-gait.json");
  const auto mean_gait = nlohmann::json::parse(stream);
  Skeleton skeleton;
  for (const auto& joint : mean_gait.at("joints")) {
    const int parent =
        joint.at("parent").is_null() ? -1 : skeleton.find(joint["parent"].get<std::string>());
    skeleton.joints.push_back({joint.at("name").get<std::string>(), parent, {0, 0, 0}, {}});
  }
  const JointRoles roles = find_roles(skeleton);
  ASSERT_TRUE(roles.has_legs());
  EXPECT_EQ(skeleton.joints[roles.left.shank].name, "LeftLeg");
  EXPECT_EQ(roles.hips_and_legs().size(), 7u);
  for (int joint = 0; joint < skeleton.size(); ++joint)
    EXPECT_NE(roles.of_joint[joint], Role::none) << skeleton.joints[joint].name;
}

// Whatever moves with a leg must not count as measured when legs are to be found from the rest.
TEST(JointRoles, hips_and_legs_hold_everything_that_moves_with_a_leg) {
  const Skeleton skeleton =
      rig("Root(Hips(Mount_L(LeftUpLeg(LeftUpLegRoll LeftLeg(LeftFoot(LeftToeBase LeftPinkyToe)))) "
          "RightUpLeg(RightLeg(RightFoot)) Spine(Head)))");
  std::vector<std::string> names;
  for (const int joint : find_roles(skeleton).hips_and_legs())
    names.push_back(skeleton.joints[joint].name);
  EXPECT_EQ(names, (std::vector<std::string>{"Hips", "Mount_L", "LeftUpLeg", "LeftUpLegRoll",
                                             "LeftLeg", "LeftFoot", "LeftToeBase", "LeftPinkyToe",
                                             "RightUpLeg", "RightLeg", "RightFoot"}));
}

TEST(JointRoles, a_leg_without_an_upper_leg_is_the_thigh_when_a_knee_hangs_on_it) {
  const Skeleton skeleton = rig("Hips(LeftLeg(LeftKnee(LeftFoot)) RightLeg(RightKnee(RightFoot)))");
  const JointRoles roles = find_roles(skeleton);
  EXPECT_EQ(skeleton.joints[roles.left.thigh].name, "LeftLeg");
  EXPECT_EQ(skeleton.joints[roles.left.shank].name, "LeftKnee");
}

TEST(JointRoles, a_table_overrides_names) {
  const Skeleton skeleton =
      rig("Hips(a(b(c)) LeftUpLeg(LeftLeg(LeftFoot)) RightUpLeg(RightLeg(RightFoot)) Spine(Head))");
  const JointRoles roles = find_roles(skeleton, {{"a", Role::left_thigh},
                                                 {"b", Role::left_shank},
                                                 {"c", Role::left_foot},
                                                 {"Head", Role::none},
                                                 {"d", Role::neck}});
  EXPECT_EQ(roles.left.thigh, skeleton.find("a"));
  EXPECT_EQ(roles.left.foot, skeleton.find("c"));
  EXPECT_EQ(roles.of_joint[skeleton.find("LeftUpLeg")], Role::none);
  EXPECT_EQ(roles.right.thigh, skeleton.find("RightUpLeg"));
  EXPECT_EQ(roles.joint(Role::head), -1);
  EXPECT_EQ(names_not_in(skeleton, {{"a", Role::none}, {"d", Role::neck}}),
            std::vector<std::string>{"d"});
}

TEST(JointRoles, names_of_roles_are_understood_in_any_spelling) {
  for (int role = 0; role <= static_cast<int>(Role::right_toes); ++role)
    EXPECT_EQ(role_from_name(role_name(static_cast<Role>(role))), static_cast<Role>(role));
  EXPECT_EQ(role_from_name("left_thigh"), Role::left_thigh);
  EXPECT_EQ(role_from_name("LeftThigh"), Role::left_thigh);
  EXPECT_EQ(role_from_name("tail"), std::nullopt);
  EXPECT_EQ(role_from_name(""), std::nullopt);
}

TEST(JointRoles, a_table_is_read_from_a_file) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder / "roles.txt") << "# my rig\n\nBone 1 = left_thigh\r\n a=b = Hips # yes\n";
  const RoleTable table = read_role_table(folder / "roles.txt");
  EXPECT_EQ(table, (RoleTable{{"Bone 1", Role::left_thigh}, {"a=b", Role::hips}}));
  EXPECT_THROW(read_role_table(folder / "missing.txt"), Error);
}

TEST(JointRoles, faults_of_a_table_are_named_with_file_and_line) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"a = hips\nb hips\n", "roles:2: expected 'joint = role'"},
      {"\n\n = hips\n", "roles:3: expected a joint's name"},
      {"a = tail\n", "roles:1: expected a role (none, hips"},
      {"a =\n", "roles:1: expected a role"},
      {"a = hips\na = head\n", "roles:2: expected each joint once, found 'a' again"}};
  for (const auto& [text, said] : faults) try {
      parse_role_table(text, "roles");
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, said.size()), said);
    }
}

}  // namespace
}  // namespace gait
