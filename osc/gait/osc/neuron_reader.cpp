// NeuronOSC, from Axis Neuron (read from github.com/fusefactory/ofxPerceptionNeuronOSC): 59 joints
// by number, place and rotation x y z w.
#include "gait/motion/humanoid.h"
#include "gait/osc/mocap_reader.h"

namespace gait::osc {

namespace {

constexpr int joints = 59, right_hand = 16, left_hand = 39;

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

int neuron_bone(int joint) {
  if (joint <= right_hand) return body_bone(joint);
  if (joint < 36) return finger_bone(joint - right_hand - 1, Bone::right_fingers);
  if (joint <= left_hand) return index_of(Bone::left_shoulder) + joint - 36;
  return finger_bone(joint - left_hand - 1, Bone::left_fingers);
}

}  // namespace

Reading read_neuron(const OscMessage& message, const Arrival& arrival, EventSink& sink) {
  if (message.path() != "/perception_joint") return Reading::unknown;
  MocapEvent event = event_of(MocapKind::bone, MocapForm::neuron, arrival);
  const auto joint = message.number(0);
  if (message.size() != 8 || !joint || !(*joint >= 0 && *joint < joints) ||
      !message.numbers(1, 3, event.place.data()) || !rotation_in(message, 4, event))
    return Reading::faulty;
  event.placed = true;
  const int bone = neuron_bone(static_cast<int>(*joint));
  if (bone >= 0) {
    event.bone = static_cast<std::int16_t>(bone);
    sink.take(event);
  }
  if (static_cast<int>(*joint) == joints - 1)
    sink.take(event_of(MocapKind::edge, MocapForm::neuron, arrival));
  return Reading::taken;
}

}  // namespace gait::osc
