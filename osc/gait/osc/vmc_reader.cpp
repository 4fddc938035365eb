// The VMC protocol (github.com/sh-akira/VirtualMotionCaptureProtocol, 2.1 to 2.7): Unity's
// humanoid, left-handed, local places and rotations. /OK and /T, which tells the sender's clock,
// end a frame; nothing else of it moves a body.
#include "gait/motion/humanoid.h"
#include "gait/osc/readers.h"

namespace gait::osc {

Reading read_vmc(const OscMessage& message, const Arrival& arrival, EventSink& sink) {
  std::string_view path = message.path();
  if (!path.starts_with("/VMC/Ext/")) return Reading::unknown;
  path.remove_prefix(9);
  if (path == "OK" || path == "T") {
    const auto number = message.number(0);
    if (!number) return Reading::faulty;
    MocapEvent edge = event_of(MocapKind::edge, MocapForm::vmc, arrival);
    if (path == "T") edge.sent = *number;
    sink.take(edge);
    return Reading::taken;
  }
  const bool root = path == "Root/Pos";
  if (!root && path != "Bone/Pos") return Reading::unknown;
  MocapEvent event = event_of(root ? MocapKind::root : MocapKind::bone, MocapForm::vmc, arrival);
  const auto name = message.text(0);
  if (!name || !message.numbers(1, 3, event.place.data()) || !rotation_in(message, 4, event))
    return Reading::faulty;
  event.placed = true;
  if (!root) {
    if (name->size() >= MocapEvent::name_size) return Reading::faulty;
    event.bone = static_cast<std::int16_t>(bone_named(*name));
    if (event.bone < 0) return Reading::unknown;
  }
  sink.take(event);
  return Reading::taken;
}

}  // namespace gait::osc
