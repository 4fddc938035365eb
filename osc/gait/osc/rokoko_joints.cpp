#include "gait/osc/rokoko_joints.h"

#include <array>
#include <string_view>

#include "gait/motion/humanoid.h"

namespace gait::osc {

namespace {

constexpr std::array<std::string_view, main_bones> body{
    "hip",           "spine",        "chest",        "",         "neck",          "head",
    "leftShoulder",  "leftUpperArm", "leftLowerArm", "leftHand", "rightShoulder", "rightUpperArm",
    "rightLowerArm", "rightHand",    "leftUpLeg",    "leftLeg",  "leftFoot",      "leftToe",
    "rightUpLeg",    "rightLeg",     "rightFoot",    "rightToe"};

bool is_left(int bone) {
  if (bone >= index_of(Bone::left_fingers)) return bone < index_of(Bone::right_fingers);
  return (bone >= index_of(Bone::left_shoulder) && bone <= index_of(Bone::left_hand)) ||
         (bone >= index_of(Bone::left_upper_leg) && bone <= index_of(Bone::left_toes));
}

// Of the left side.
Eigen::Quaterniond left_t_pose(int bone) {
  constexpr double r = 0.70710678118654752;
  if (bone == index_of(Bone::left_shoulder)) return {-r, 0, 0, r};  // w x y z
  if (bone == index_of(Bone::left_upper_leg) || bone == index_of(Bone::left_lower_leg))
    return {r, 0, r, 0};
  if (bone == index_of(Bone::left_foot) || bone == index_of(Bone::left_toes)) return {0, 0, r, -r};
  if (bone == index_of(Bone::left_fingers))
    return Eigen::Quaterniond(-0.092, -0.561, -0.701, 0.430).normalized();
  if (bone == index_of(Bone::left_fingers) + 1 || bone == index_of(Bone::left_fingers) + 2)
    return Eigen::Quaterniond(-0.271, -0.653, -0.653, 0.271).normalized();
  return {-0.5, -0.5, -0.5, 0.5};  // arm, hand, fingers
}

}  // namespace

std::string rokoko_joint(int bone) {
  if (bone < 0) return {};
  if (bone < main_bones) return std::string(body[static_cast<std::size_t>(bone)]);
  if (bone < index_of(Bone::left_fingers)) return {};
  constexpr std::array<std::string_view, 5> fingers{"Thumb", "Index", "Middle", "Ring", "Little"};
  constexpr std::array<std::string_view, 3> pieces{"Proximal", "Medial", "Distal"};
  const int finger = (bone - index_of(Bone::left_fingers)) % 15;
  return std::string(is_left(bone) ? "left" : "right") +
         std::string(fingers[static_cast<std::size_t>(finger / 3)]) +
         std::string(pieces[static_cast<std::size_t>(finger % 3)]);
}

int rokoko_bone(const std::string& joint) {
  for (int bone = 0; bone < humanoid_bones; ++bone)
    if (!joint.empty() && rokoko_joint(bone) == joint) return bone;
  return -1;
}

Eigen::Quaterniond rokoko_t_pose(int bone) {
  if (bone == index_of(Bone::hips)) return Eigen::Quaterniond::Identity();
  if (bone <= index_of(Bone::head)) return {0, 0, 0, 1};
  if (is_left(bone)) return left_t_pose(bone);
  int left = bone - 15;
  if (bone < index_of(Bone::left_upper_leg)) left = bone - 4;
  if (bone >= index_of(Bone::right_upper_leg) && bone <= index_of(Bone::right_toes))
    left = bone - 4;
  return mirrored(left_t_pose(left));
}

}  // namespace gait::osc
