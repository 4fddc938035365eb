// NeuronOSC, from Axis Neuron (read from github.com/fusefactory/ofxPerceptionNeuronOSC): 59 joints
// by number, place and rotation x y z w.
#include "gait/osc/neuron_joints.h"
#include "gait/osc/readers.h"

namespace gait::osc {

Reading read_neuron(const OscMessage& message, const Arrival& arrival, EventSink& sink) {
  if (message.path() != "/perception_joint") return Reading::unknown;
  MocapEvent event = event_of(MocapKind::bone, MocapForm::neuron, arrival);
  const auto joint = message.number(0);
  if (message.size() != 8 || !joint || !(*joint >= 0 && *joint < neuron_joints) ||
      !message.numbers(1, 3, event.place.data()) || !rotation_in(message, 4, event))
    return Reading::faulty;
  event.placed = true;
  const int bone = neuron_bone(static_cast<int>(*joint));
  if (bone >= 0) {
    event.bone = static_cast<std::int16_t>(bone);
    sink.take(event);
  }
  if (static_cast<int>(*joint) == neuron_joints - 1)
    sink.take(event_of(MocapKind::edge, MocapForm::neuron, arrival));
  return Reading::taken;
}

}  // namespace gait::osc
