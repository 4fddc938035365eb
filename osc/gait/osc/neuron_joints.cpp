#include "gait/osc/neuron_joints.h"

#include <array>

#include "gait/motion/humanoid.h"

namespace gait::osc {

namespace {

constexpr int right_hand = 16, left_hand = 39;

// The body; hands follow theirs. Its spine has four joints, the humanoid's three.
int body_bone(int joint) {
  constexpr std::array<Bone, 17> body{
      Bone::hips,           Bone::right_upper_leg, Bone::right_lower_leg, Bone::right_foot,
      Bone::left_upper_leg, Bone::left_lower_leg,  Bone::left_foot,       Bone::spine,
      Bone::chest,          Bone::jaw /* none */,  Bone::upper_chest,     Bone::neck,
      Bone::head,           Bone::right_shoulder,  Bone::right_upper_arm, Bone::right_lower_arm,
      Bone::right_hand};
  const Bone bone = body[static_cast<std::size_t>(joint)];
  return bone == Bone::jaw ? -1 : index_of(bone);
}

// Nineteen joints of fingers: thumb 1 to 3, then per finger one within the hand and 1 to 3.
int finger_bone(int joint, Bone fingers) {
  if (joint < 3) return index_of(fingers) + joint;
  const int finger = (joint - 3) / 4, piece = (joint - 3) % 4;
  return piece == 0 ? -1 : index_of(fingers) + 3 * (finger + 1) + piece - 1;
}

}  // namespace

int neuron_bone(int joint) {
  if (joint <= right_hand) return body_bone(joint);
  if (joint < 36) return finger_bone(joint - right_hand - 1, Bone::right_fingers);
  if (joint <= left_hand) return index_of(Bone::left_shoulder) + joint - 36;
  return finger_bone(joint - left_hand - 1, Bone::left_fingers);
}

int neuron_joint(int bone) {
  for (int joint = 0; joint < neuron_joints; ++joint)
    if (neuron_bone(joint) == bone) return joint;
  return -1;
}

}  // namespace gait::osc
