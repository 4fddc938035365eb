// Names of rigs, as programs and suits give them: understood as a set, without any help of the tree
// (all bones here have no length).
#include <gtest/gtest.h>

#include <sstream>

#include "gait/motion/humanoid.h"
#include "gait/motion/joint_roles.h"

namespace gait {
namespace {

// `trunk`: hips, spine ..., neck, head. `left`, `right`: collar bone, upper arm, forearm, hand,
// thigh, shank, foot, toes; "-": there is none. A tilde stands for a space in a name.
struct Scheme {
  const char *maker, *trunk, *left, *right;
  const char* helpers = "";  // further joints, "parent/name", that have no role
};

const std::vector<Scheme> schemes{
    {"Mixamo", "mixamorig:Hips mixamorig:Spine mixamorig:Spine1 mixamorig:Neck mixamorig:Head",
     "mixamorig:LeftShoulder mixamorig:LeftArm mixamorig:LeftForeArm mixamorig:LeftHand "
     "mixamorig:LeftUpLeg mixamorig:LeftLeg mixamorig:LeftFoot mixamorig:LeftToeBase",
     "mixamorig:RightShoulder mixamorig:RightArm mixamorig:RightForeArm mixamorig:RightHand "
     "mixamorig:RightUpLeg mixamorig:RightLeg mixamorig:RightFoot mixamorig:RightToeBase",
     "mixamorig:LeftHand/mixamorig:LeftHandThumb1 mixamorig:Head/mixamorig:HeadTop_End"},
    {"Mixamo as one word", "mixamorigHips mixamorigSpine mixamorigNeck mixamorigHead",
     "mixamorigLeftShoulder mixamorigLeftArm mixamorigLeftForeArm mixamorigLeftHand "
     "mixamorigLeftUpLeg mixamorigLeftLeg mixamorigLeftFoot mixamorigLeftToeBase",
     "mixamorigRightShoulder mixamorigRightArm mixamorigRightForeArm mixamorigRightHand "
     "mixamorigRightUpLeg mixamorigRightLeg mixamorigRightFoot mixamorigRightToeBase",
     "mixamorigLeftHand/mixamorigLeftHandIndex1"},
    {"Poser", "hip abdomen chest neck head",
     "lCollar lShldr lForeArm lHand lThigh lShin lFoot lToe",
     "rCollar rShldr rForeArm rHand rThigh rShin rFoot rToe",
     "head/leftEye lHand/lThumb1 lHand/lIndex1"},
    {"Poser with buttocks", "hip abdomen chest neck head",
     "lCollar lShldr lForeArm lHand lThigh lShin lFoot lToe",
     "rCollar rShldr rForeArm rHand rThigh rShin rFoot rToe", "hip/lButtock hip/rButtock"},
    {"DAZ Genesis 3 and 8", "hip abdomenLower abdomenUpper chestLower chestUpper neckLower head",
     "lCollar lShldrBend lForearmBend lHand lThighBend lShin lFoot lToe",
     "rCollar rShldrBend rForearmBend rHand rThighBend rShin rFoot rToe",
     "lShldrBend/lShldrTwist lForearmBend/lForearmTwist lThighBend/lThighTwist "
     "rShldrBend/rShldrTwist rForearmBend/rForearmTwist rThighBend/rThighTwist "
     "lFoot/lMetatarsals lToe/lBigToe hip/pelvis chestUpper/lPectoral"},
    {"DAZ Genesis 9", "hip spine1 spine2 spine3 spine4 neck1 head",
     "l_shoulder l_upperarm l_forearm l_hand l_thigh l_shin l_foot l_toes",
     "r_shoulder r_upperarm r_forearm r_hand r_thigh r_shin r_foot r_toes",
     "l_thigh/l_thightwist1 l_thigh/l_thightwist2 l_forearm/l_forearmtwist1 hip/pelvis "
     "l_foot/l_metatarsal l_hand/l_thumb1"},
    {"Second Life", "mPelvis mTorso mChest mNeck mHead",
     "mCollarLeft mShoulderLeft mElbowLeft mWristLeft mHipLeft mKneeLeft mAnkleLeft mToeLeft",
     "mCollarRight mShoulderRight mElbowRight mWristRight mHipRight mKneeRight mAnkleRight "
     "mToeRight",
     "mHead/mSkull_End mHead/mEyeLeft mWristLeft/mHandThumb1Left"},
    {"Motive", "Hip Ab Chest Neck Head", "LShoulder LUArm LFArm LHand LThigh LShin LFoot LToe",
     "RShoulder RUArm RFArm RHand RThigh RShin RFoot RToe", "LHand/LThumb1 LHand/LPinky3"},
    {"Motive with the asset's name", "Lee_Hip Lee_Ab Lee_Chest Lee_Neck Lee_Head",
     "Lee_LShoulder Lee_LUArm Lee_LFArm Lee_LHand Lee_LThigh Lee_LShin Lee_LFoot Lee_LToe",
     "Lee_RShoulder Lee_RUArm Lee_RFArm Lee_RHand Lee_RThigh Lee_RShin Lee_RFoot Lee_RToe"},
    {"Motive, FBX names", "Bob_Hips Bob_Spine Bob_Spine1 Bob_Neck Bob_Head",
     "Bob_LeftShoulder Bob_LeftArm Bob_LeftForeArm Bob_LeftHand Bob_LeftUpLeg Bob_LeftLeg "
     "Bob_LeftFoot Bob_LeftToeBase",
     "Bob_RightShoulder Bob_RightArm Bob_RightForeArm Bob_RightHand Bob_RightUpLeg Bob_RightLeg "
     "Bob_RightFoot Bob_RightToeBase"},
    {"Motive, BVH names", "Hips Chest Chest2 Neck Head",
     "LeftCollar LeftShoulder LeftElbow LeftWrist LeftHip LeftKnee LeftAnkle LeftToe",
     "RightCollar RightShoulder RightElbow RightWrist RightHip RightKnee RightAnkle RightToe"},
    {"DeepMotion", "hips_JNT spine_JNT spine1_JNT spine2_JNT neck_JNT head_JNT",
     "l_shoulder_JNT l_arm_JNT l_forearm_JNT l_hand_JNT l_upleg_JNT l_leg_JNT l_foot_JNT "
     "l_toebase_JNT",
     "r_shoulder_JNT r_arm_JNT r_forearm_JNT r_hand_JNT r_upleg_JNT r_leg_JNT r_foot_JNT "
     "r_toebase_JNT",
     "l_hand_JNT/l_handThumb1_JNT"},
    {"Rigify, deform bones of a game rig", "DEF-hips DEF-spine.001 DEF-spine.002 DEF-neck DEF-head",
     "DEF-shoulder.L DEF-upper_arm.L DEF-forearm.L DEF-hand.L DEF-thigh.L DEF-shin.L DEF-foot.L "
     "DEF-toe.L",
     "DEF-shoulder.R DEF-upper_arm.R DEF-forearm.R DEF-hand.R DEF-thigh.R DEF-shin.R DEF-foot.R "
     "DEF-toe.R",
     "DEF-hips/DEF-pelvis.L DEF-spine.002/DEF-breast.L"},
    {"MMD", "腰 上半身 上半身2 首 頭", "左肩 左腕 左ひじ 左手首 左足 左ひざ 左足首 左つま先",
     "右肩 右腕 右ひじ 右手首 右足 右ひざ 右足首 右つま先",
     "左腕/左腕捩 左ひじ/左手捩 左足首/左足ＩＫ 左足首/左つま先ＩＫ 左足/左足D 腰/下半身"},
    {"Japanese, in anatomists' words", "骨盤 脊椎 胸 首 頭",
     "左鎖骨 左上腕 左前腕 左手 左大腿 左下腿 左足首 左つま先",
     "右鎖骨 右上腕 右前腕 右手 右大腿 右下腿 右足首 右つま先"},
    {"MMD in English", "waist upper~body upper~body2 neck head",
     "shoulder_L arm_L elbow_L wrist_L leg_L knee_L ankle_L toe_L",
     "shoulder_R arm_R elbow_R wrist_R leg_R knee_R ankle_R toe_R",
     "ankle_L/leg~IK_L arm_L/arm~twist_L"},
    {"German", "Becken Bauch Brust Hals Kopf",
     "SchlüsselbeinLinks OberarmLinks UnterarmLinks HandLinks OberschenkelLinks "
     "UnterschenkelLinks FußLinks ZehenLinks",
     "SchlüsselbeinRechts OberarmRechts UnterarmRechts HandRechts OberschenkelRechts "
     "UnterschenkelRechts FußRechts ZehenRechts"},
    {"German, sides before", "Hüfte Wirbelsäule Brustkorb Nacken Kopf",
     "linke_Schulter linker_Oberarm linker_Ellbogen linkes_Handgelenk linker_Oberschenkel "
     "linkes_Knie linker_Knöchel linke_Zehe",
     "rechte_Schulter rechter_Oberarm rechter_Ellbogen rechtes_Handgelenk rechter_Oberschenkel "
     "rechtes_Knie rechter_Knöchel rechte_Zehe"},
    {"3ds Max Biped", "Bip01~Pelvis Bip01~Spine Bip01~Spine1 Bip01~Neck Bip01~Head",
     "Bip01~L~Clavicle Bip01~L~UpperArm Bip01~L~Forearm Bip01~L~Hand Bip01~L~Thigh Bip01~L~Calf "
     "Bip01~L~Foot Bip01~L~Toe0",
     "Bip01~R~Clavicle Bip01~R~UpperArm Bip01~R~Forearm Bip01~R~Hand Bip01~R~Thigh Bip01~R~Calf "
     "Bip01~R~Foot Bip01~R~Toe0",
     "Bip01~Head/Bip01~HeadNub Bip01~L~Hand/Bip01~L~Finger0 Bip01~L~Forearm/Bip01~L~ForeTwist"},
    {"Valve",
     "ValveBiped.Bip01_Pelvis ValveBiped.Bip01_Spine ValveBiped.Bip01_Spine4 "
     "ValveBiped.Bip01_Neck1 ValveBiped.Bip01_Head1",
     "ValveBiped.Bip01_L_Clavicle ValveBiped.Bip01_L_UpperArm ValveBiped.Bip01_L_Forearm "
     "ValveBiped.Bip01_L_Hand ValveBiped.Bip01_L_Thigh ValveBiped.Bip01_L_Calf "
     "ValveBiped.Bip01_L_Foot ValveBiped.Bip01_L_Toe0",
     "ValveBiped.Bip01_R_Clavicle ValveBiped.Bip01_R_UpperArm ValveBiped.Bip01_R_Forearm "
     "ValveBiped.Bip01_R_Hand ValveBiped.Bip01_R_Thigh ValveBiped.Bip01_R_Calf "
     "ValveBiped.Bip01_R_Foot ValveBiped.Bip01_R_Toe0"},
    {"Unreal", "pelvis spine_01 spine_02 neck_01 head",
     "clavicle_l upperarm_l lowerarm_l hand_l thigh_l calf_l foot_l ball_l",
     "clavicle_r upperarm_r lowerarm_r hand_r thigh_r calf_r foot_r ball_r",
     "upperarm_l/upperarm_twist_01_l lowerarm_l/lowerarm_twist_01_l thigh_l/thigh_twist_01_l "
     "calf_l/calf_twist_01_l hand_l/thumb_01_l"},
    {"HumanIK",
     "Character1_Hips Character1_Spine Character1_Spine1 Character1_Neck Character1_Head",
     "Character1_LeftShoulder Character1_LeftArm Character1_LeftForeArm Character1_LeftHand "
     "Character1_LeftUpLeg Character1_LeftLeg Character1_LeftFoot Character1_LeftToeBase",
     "Character1_RightShoulder Character1_RightArm Character1_RightForeArm Character1_RightHand "
     "Character1_RightUpLeg Character1_RightLeg Character1_RightFoot Character1_RightToeBase",
     "Character1_LeftArm/Character1_LeftArmRoll Character1_LeftUpLeg/Character1_LeftUpLegRoll "
     "Character1_LeftLeg/Character1_LeftLegRoll Character1_LeftHand/Character1_LeftInHandIndex"},
    {"Xsens MVN", "Pelvis L5 L3 T12 T8 Neck Head",
     "LeftShoulder LeftUpperArm LeftForeArm LeftHand LeftUpperLeg LeftLowerLeg LeftFoot LeftToe",
     "RightShoulder RightUpperArm RightForeArm RightHand RightUpperLeg RightLowerLeg RightFoot "
     "RightToe"},
    {"Xsens MVN with spaces", "Pelvis L5 L3 T12 T8 Neck Head",
     "Left~Shoulder Left~Upper~Arm Left~Forearm Left~Hand Left~Upper~Leg Left~Lower~Leg Left~Foot "
     "Left~Toe",
     "Right~Shoulder Right~Upper~Arm Right~Forearm Right~Hand Right~Upper~Leg Right~Lower~Leg "
     "Right~Foot Right~Toe"},
    {"Xsens joints", "Pelvis jL5S1 jL4L3 jL1T12 jT9T8 jT1C7 jC1Head",
     "jLeftT4Shoulder jLeftShoulder jLeftElbow jLeftWrist jLeftHip jLeftKnee jLeftAnkle "
     "jLeftBallFoot",
     "jRightT4Shoulder jRightShoulder jRightElbow jRightWrist jRightHip jRightKnee jRightAnkle "
     "jRightBallFoot"},
    {"Rokoko", "Hips Spine Spine2 Spine4 Neck Head",
     "LeftShoulder LeftArm LeftForeArm LeftHand LeftThigh LeftShin LeftFoot LeftToe",
     "RightShoulder RightArm RightForeArm RightHand RightThigh RightShin RightFoot RightToe"},
    {"Rokoko Studio live", "hip spine chest neck head",
     "leftShoulder leftUpperArm leftLowerArm leftHand leftUpLeg leftLeg leftFoot leftToe",
     "rightShoulder rightUpperArm rightLowerArm rightHand rightUpLeg rightLeg rightFoot rightToe",
     "leftHand/leftThumbProximal"},
    {"Perception Neuron", "Robot_Hips Robot_Spine Robot_Spine1 Robot_Neck Robot_Head",
     "Robot_LeftShoulder Robot_LeftArm Robot_LeftForeArm Robot_LeftHand Robot_LeftUpLeg "
     "Robot_LeftLeg Robot_LeftFoot -",
     "Robot_RightShoulder Robot_RightArm Robot_RightForeArm Robot_RightHand Robot_RightUpLeg "
     "Robot_RightLeg Robot_RightFoot -",
     "Robot_LeftHand/Robot_LeftInHandIndex"},
    {"Kinect 2", "SpineBase SpineMid SpineShoulder Neck Head",
     "- ShoulderLeft ElbowLeft WristLeft HipLeft KneeLeft AnkleLeft -",
     "- ShoulderRight ElbowRight WristRight HipRight KneeRight AnkleRight -",
     "WristLeft/ThumbLeft"},
    {"Kinect 1", "HipCenter Spine ShoulderCenter Neck Head",
     "- ShoulderLeft ElbowLeft WristLeft HipLeft KneeLeft AnkleLeft -",
     "- ShoulderRight ElbowRight WristRight HipRight KneeRight AnkleRight -"},
    {"Azure Kinect", "PELVIS SPINE_NAVAL SPINE_CHEST NECK HEAD",
     "CLAVICLE_LEFT SHOULDER_LEFT ELBOW_LEFT WRIST_LEFT HIP_LEFT KNEE_LEFT ANKLE_LEFT -",
     "CLAVICLE_RIGHT SHOULDER_RIGHT ELBOW_RIGHT WRIST_RIGHT HIP_RIGHT KNEE_RIGHT ANKLE_RIGHT -",
     "WRIST_LEFT/THUMB_LEFT HEAD/EYE_LEFT"},
    {"CMU", "Hips LowerBack Spine Spine1 Neck Head",
     "LeftShoulder LeftArm LeftForeArm LeftHand LeftUpLeg LeftLeg LeftFoot LeftToeBase",
     "RightShoulder RightArm RightForeArm RightHand RightUpLeg RightLeg RightFoot RightToeBase",
     "Hips/LHipJoint LeftHand/LThumb"},
    {"CMU for 3ds Max", "Hips lowerback Chest Chest2 lowerneck Head",
     "LeftCollar LeftShoulder LeftElbow LeftWrist LeftHip LeftKnee LeftAnkle LeftToe",
     "RightCollar RightShoulder RightElbow RightWrist RightHip RightKnee RightAnkle RightToe",
     "LeftWrist/LFingers LeftWrist/LThumb"},
    {"Vicon", "Pelvis Thorax Neck Head",
     "LClavicle LHumerus LRadius LHand LFemur LTibia LFoot LToes",
     "RClavicle RHumerus RRadius RHand RFemur RTibia RFoot RToes"},
    {"SMPL", "m_avg_Pelvis m_avg_Spine1 m_avg_Spine2 m_avg_Neck m_avg_Head",
     "m_avg_L_Collar m_avg_L_Shoulder m_avg_L_Elbow m_avg_L_Wrist m_avg_L_Hip m_avg_L_Knee "
     "m_avg_L_Ankle m_avg_L_Foot",
     "m_avg_R_Collar m_avg_R_Shoulder m_avg_R_Elbow m_avg_R_Wrist m_avg_R_Hip m_avg_R_Knee "
     "m_avg_R_Ankle m_avg_R_Foot"},
    {"SMPL-X", "pelvis spine1 spine2 spine3 neck head",
     "left_collar left_shoulder left_elbow left_wrist left_hip left_knee left_ankle left_foot",
     "right_collar right_shoulder right_elbow right_wrist right_hip right_knee right_ankle "
     "right_foot",
     "head/left_eye_smplhf left_wrist/left_index1"},
    {"VRM", "hips spine chest upperChest neck head",
     "leftShoulder leftUpperArm leftLowerArm leftHand leftUpperLeg leftLowerLeg leftFoot leftToes",
     "rightShoulder rightUpperArm rightLowerArm rightHand rightUpperLeg rightLowerLeg rightFoot "
     "rightToes",
     "leftHand/leftThumbProximal head/leftEye"},
    {"VRoid", "J_Bip_C_Hips J_Bip_C_Spine J_Bip_C_Chest J_Bip_C_Neck J_Bip_C_Head",
     "J_Bip_L_Shoulder J_Bip_L_UpperArm J_Bip_L_LowerArm J_Bip_L_Hand J_Bip_L_UpperLeg "
     "J_Bip_L_LowerLeg J_Bip_L_Foot J_Bip_L_ToeBase",
     "J_Bip_R_Shoulder J_Bip_R_UpperArm J_Bip_R_LowerArm J_Bip_R_Hand J_Bip_R_UpperLeg "
     "J_Bip_R_LowerLeg J_Bip_R_Foot J_Bip_R_ToeBase",
     "J_Bip_C_Head/J_Sec_Hair1_01"},
    {"Unity", "Hips Spine Chest Neck Head",
     "LeftShoulder LeftUpperArm LeftLowerArm LeftHand LeftUpperLeg LeftLowerLeg LeftFoot LeftToes",
     "RightShoulder RightUpperArm RightLowerArm RightHand RightUpperLeg RightLowerLeg RightFoot "
     "RightToes"},
    {"mocopi", "root torso_1 torso_2 torso_7 neck_1 head",
     "l_shoulder l_up_arm l_low_arm l_hand l_up_leg l_low_leg l_foot l_toes",
     "r_shoulder r_up_arm r_low_arm r_hand r_up_leg r_low_leg r_foot r_toes"},
    {"Reallusion", "CC_Base_Hip CC_Base_Waist CC_Base_Spine01 CC_Base_NeckTwist01 CC_Base_Head",
     "CC_Base_L_Clavicle CC_Base_L_Upperarm CC_Base_L_Forearm CC_Base_L_Hand CC_Base_L_Thigh "
     "CC_Base_L_Calf CC_Base_L_Foot CC_Base_L_ToeBase",
     "CC_Base_R_Clavicle CC_Base_R_Upperarm CC_Base_R_Forearm CC_Base_R_Hand CC_Base_R_Thigh "
     "CC_Base_R_Calf CC_Base_R_Foot CC_Base_R_ToeBase",
     "CC_Base_L_Upperarm/CC_Base_L_UpperarmTwist01 CC_Base_L_Thigh/CC_Base_L_ThighTwist01 "
     "CC_Base_L_Calf/CC_Base_L_CalfTwist01"},
    {"Advanced Skeleton", "Root_M Spine1_M Chest_M Neck_M Head_M",
     "Scapula_L Shoulder_L Elbow_L Wrist_L Hip_L Knee_L Ankle_L Toes_L",
     "Scapula_R Shoulder_R Elbow_R Wrist_R Hip_R Knee_R Ankle_R Toes_R"},
    {"iPi Soft", "Hip LowerSpine MiddleSpine Chest Neck Head",
     "LClavicle LShoulder LForearm LHand LThigh LShin LFoot LToe",
     "RClavicle RShoulder RForearm RHand RThigh RShin RFoot RToe"},
    {"Roblox", "LowerTorso UpperTorso Neck Head",
     "- LeftUpperArm LeftLowerArm LeftHand LeftUpperLeg LeftLowerLeg LeftFoot -",
     "- RightUpperArm RightLowerArm RightHand RightUpperLeg RightLowerLeg RightFoot -"},
    {"OpenSim", "pelvis torso neck head",
     "- humerus_l ulna_l hand_l femur_l tibia_l talus_l toes_l",
     "- humerus_r ulna_r hand_r femur_r tibia_r talus_r toes_r"},
    {"ARKit", "hips_joint spine_1_joint spine_7_joint neck_1_joint head_joint",
     "left_shoulder_1_joint left_arm_joint left_forearm_joint left_hand_joint left_upLeg_joint "
     "left_leg_joint left_foot_joint left_toes_joint",
     "right_shoulder_1_joint right_arm_joint right_forearm_joint right_hand_joint "
     "right_upLeg_joint right_leg_joint right_foot_joint right_toes_joint",
     "left_toes_joint/left_toesEnd_joint"},
    {"Maya, sides of two letters", "hips_bind spine_bind chest_bind neck_bind head_bind",
     "lf_clavicle_bind lf_arm_bind lf_elbow_bind lf_hand_bind lf_upleg_bind lf_knee_bind "
     "lf_foot_bind lf_toe_bind",
     "rt_clavicle_bind rt_arm_bind rt_elbow_bind rt_hand_bind rt_upleg_bind rt_knee_bind "
     "rt_foot_bind rt_toe_bind"},
    {"references with sides behind", "Hips_ref belly_ref Torso_ref neck_ref head_ref",
     "shoulder_ref_L arm_ref_L forearm_ref_L hand_ref_L upleg_ref_L leg_ref_L foot_ref_L "
     "toe_ref_L",
     "shoulder_ref_R arm_ref_R forearm_ref_R hand_ref_R upleg_ref_R leg_ref_R foot_ref_R "
     "toe_ref_R"},
    {"parts before what they are of", "Hips Spine Chest Neck Head",
     "Clav_L Arm_Upper_L Arm_Lower_L Hand_L Leg_Upper_L Leg_Lower_L Foot_L Toe_L",
     "Clav_R Arm_Upper_R Arm_Lower_R Hand_R Leg_Upper_R Leg_Lower_R Foot_R Toe_R"},
    {"twist joints above what they twist", "Hips Spine Spine1 Neck Head",
     "LeftShoulder LeftArm LeftForeArm LeftHand LeftUpLeg LeftLeg LeftFoot LeftToeBase",
     "RightShoulder RightArm RightForeArm RightHand RightUpLeg RightLeg RightFoot RightToeBase",
     "LeftUpLeg/LeftLeg_Roll RightUpLeg/RightLeg_Roll LeftArm/LeftForeArm_Roll"},
};

constexpr std::array<Role, 8> left_roles{Role::left_shoulder, Role::left_arm,   Role::left_forearm,
                                         Role::left_hand,     Role::left_thigh, Role::left_shank,
                                         Role::left_foot,     Role::left_toes};

std::vector<std::string> words(const char* text) {
  std::istringstream stream(text);
  std::vector<std::string> found;
  for (std::string word; stream >> word;) {
    std::ranges::replace(word, '~', ' ');
    found.push_back(word);
  }
  return found;
}

struct Rig {
  Skeleton skeleton;
  std::vector<Role> expected;  // one per joint

  void add(const std::string& name, int parent, Role role) {
    skeleton.joints.push_back({name, parent, {0, 0, 0}});
    expected.push_back(role);
  }
};

Role other_side(Role role) {
  std::string name(role_name(role));
  return *role_from_name("right" + name.substr(4));
}

Rig rig_of(const Scheme& scheme) {
  Rig rig;
  const std::vector<std::string> trunk = words(scheme.trunk);
  for (std::size_t i = 0; i < trunk.size(); ++i)
    rig.add(trunk[i], static_cast<int>(i) - 1,
            i == 0                  ? Role::hips
            : i + 1 == trunk.size() ? Role::head
            : i + 2 == trunk.size() ? Role::neck
                                    : Role::spine);
  const int chest = static_cast<int>(trunk.size()) - 3;
  for (const bool left : {true, false}) {
    const std::vector<std::string> names = words(left ? scheme.left : scheme.right);
    int parent = chest;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (i == 4) parent = 0;
      if (names[i] == "-") continue;
      rig.add(names[i], parent, left ? left_roles[i] : other_side(left_roles[i]));
      parent = rig.skeleton.size() - 1;
    }
  }
  for (const std::string& helper : words(scheme.helpers)) {
    const std::size_t slash = helper.find('/');
    rig.add(helper.substr(slash + 1), rig.skeleton.find(helper.substr(0, slash)), Role::none);
  }
  return rig;
}

TEST(NamingSchemes, are_understood) {
  for (const Scheme& scheme : schemes) {
    const Rig rig = rig_of(scheme);
    const JointRoles roles = find_roles(rig.skeleton);
    EXPECT_TRUE(roles.has_legs()) << scheme.maker;
    for (int joint = 0; joint < rig.skeleton.size(); ++joint)
      EXPECT_EQ(role_name(roles.of_joint[joint]), role_name(rig.expected[joint]))
          << scheme.maker << ": " << rig.skeleton.joints[joint].name;
  }
}

// What exporters add must change nothing.
TEST(NamingSchemes, are_understood_with_anything_added) {
  const std::vector<std::pair<const char*, const char*>> added{
      {"", "_JNT"},     {"", "_bind"},     {"", "_ref"},     {"", "_M"},      {"", "Joint"},
      {"", "Bone"},     {"Actor:", ""},    {"ns1:ns2:", ""}, {"Dancer_", ""}, {"A01_", ""},
      {"bone_", "_01"}, {"Skeleton|", ""}, {"DEF-", ""},     {"CC_Base_", ""}};
  for (const Scheme& scheme : schemes)
    for (const auto& [before, behind] : added) {
      Rig rig = rig_of(scheme);
      for (Joint& joint : rig.skeleton.joints) joint.name = before + joint.name + behind;
      const JointRoles roles = find_roles(rig.skeleton);
      for (int joint = 0; joint < rig.skeleton.size(); ++joint)
        EXPECT_EQ(role_name(roles.of_joint[joint]), role_name(rig.expected[joint]))
            << scheme.maker << ": " << rig.skeleton.joints[joint].name;
    }
}

TEST(NamingSchemes, a_hip_above_a_hip_is_its_mount) {
  Skeleton skeleton;
  for (const auto& [name, parent] : {std::pair{"Hips", -1},
                                     {"LHipJoint", 0},
                                     {"LeftHip", 1},
                                     {"LeftKnee", 2},
                                     {"LeftAnkle", 3},
                                     {"RHipJoint", 0},
                                     {"RightHip", 5},
                                     {"RightKnee", 6},
                                     {"RightAnkle", 7}})
    skeleton.joints.push_back({name, parent, {0, 0, 0}});
  const JointRoles roles = find_roles(skeleton);
  EXPECT_EQ(roles.left.thigh, 2);
  EXPECT_EQ(roles.right.thigh, 6);
  EXPECT_TRUE(roles.in_leg[1]);
  EXPECT_EQ(roles.of_joint[1], Role::none);
}

TEST(NamingSchemes, the_same_word_means_what_the_other_names_make_of_it) {
  const std::vector<std::string> with_upper_arm{"Hip", "LShoulder", "LUArm", "LFArm"};
  EXPECT_EQ(roles_of_names(with_upper_arm)[1], Role::left_shoulder);
  const std::vector<std::string> with_elbow{"Hips", "LeftShoulder", "LeftElbow", "LeftWrist"};
  EXPECT_EQ(roles_of_names(with_elbow)[1], Role::left_arm);
}

}  // namespace
}  // namespace gait
