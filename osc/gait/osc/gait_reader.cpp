// The project's own form (osc/README.md): right-handed, Y up, metres, joints by their own names.
#include <algorithm>
#include <cmath>

#include "gait/osc/captured_frame.h"
#include "gait/osc/readers.h"

namespace gait::osc {

namespace {

bool name_in(const OscMessage& message, int i, std::array<char, MocapEvent::name_size>& name,
             bool may_be_empty = false) {
  const auto text = message.text(i);
  if (!text || text->size() >= name.size() || (text->empty() && !may_be_empty)) return false;
  std::copy(text->begin(), text->end(), name.begin());
  return true;
}

Reading frame(const OscMessage& message, const Arrival& arrival, EventSink& sink) {
  if (message.size() == 0 || message.size() > most_values) return Reading::faulty;
  for (int i = 0; i < message.size(); ++i)
    if (!message.number(i) || std::abs(*message.number(i)) > 1e6) return Reading::faulty;
  MocapEvent event = event_of(MocapKind::values, MocapForm::gait, arrival);
  for (int first = 0; first < message.size(); first += event.count) {
    event.first = static_cast<std::int16_t>(first);
    event.count = static_cast<std::int16_t>(
        std::min(static_cast<int>(MocapEvent::most_numbers), message.size() - first));
    message.numbers(first, event.count, event.numbers.data());
    sink.take(event);
  }
  sink.take(event_of(MocapKind::edge, MocapForm::gait, arrival));
  return Reading::taken;
}

Reading joint(const OscMessage& message, bool relative, const Arrival& arrival, EventSink& sink) {
  MocapEvent event = event_of(MocapKind::joint, MocapForm::gait, arrival);
  if (!name_in(message, 0, event.name)) return Reading::faulty;
  event.relative = relative;
  if (relative) {
    if (!message.numbers(1, 3, event.numbers.data())) return Reading::faulty;
    event.rotated = true;
  } else {
    if (!rotation_in(message, 1, event)) return Reading::faulty;
    event.placed = message.size() >= 8;
    if (event.placed && !message.numbers(5, 3, event.place.data())) return Reading::faulty;
  }
  sink.take(event);
  return Reading::taken;
}

}  // namespace

Reading read_gait(const OscMessage& message, const Arrival& arrival, EventSink& sink) {
  std::string_view path = message.path();
  if (!path.starts_with("/gait/")) return Reading::unknown;
  path.remove_prefix(6);
  if (path == "frame") return frame(message, arrival, sink);
  if (path == "joint" || path == "quat") return joint(message, path == "joint", arrival, sink);
  if (path == "end") {
    sink.take(event_of(MocapKind::edge, MocapForm::gait, arrival));
    return Reading::taken;
  }
  if (path == "root") {
    MocapEvent event = event_of(MocapKind::root, MocapForm::gait, arrival);
    if (!message.numbers(0, 3, event.place.data()) || !message.numbers(3, 1, event.numbers.data()))
      return Reading::faulty;
    event.placed = true;
    sink.take(event);
    return Reading::taken;
  }
  if (path == "bone") {
    MocapEvent event = event_of(MocapKind::rig, MocapForm::gait, arrival);
    if (!name_in(message, 0, event.name) || !name_in(message, 1, event.parent, true) ||
        !message.numbers(2, 3, event.place.data()))
      return Reading::faulty;
    sink.take(event);
    return Reading::taken;
  }
  return Reading::unknown;
}

}  // namespace gait::osc
