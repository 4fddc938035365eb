// NatNetThree2OSC (github.com/tecartlab/app_NatNetThree2OSC, 6.0 to 9.1), from OptiTrack Motive:
// skeletons in its four modes, right-handed, Y up, metres. Rigid bodies and markers are passed
// over.

#include "gait/motion/humanoid.h"
#include "gait/numbers.h"
#include "gait/osc/natnet_names.h"
#include "gait/osc/readers.h"

namespace gait::osc {

namespace {

// "/skeleton/NAME/bone/7/quat": the parts after "/skeleton/".
struct Path {
  std::string_view skeleton, kind, number, what;
};

Path parts_of(std::string_view path) {
  Path parts;
  for (std::string_view* part : {&parts.skeleton, &parts.kind, &parts.number, &parts.what}) {
    const std::size_t end = path.find('/');
    *part = path.substr(0, end);
    if (end == std::string_view::npos) break;
    path.remove_prefix(end + 1);
  }
  return parts;
}

bool places(const OscMessage& message, int first, MocapEvent& event) {
  event.placed = message.numbers(first, 3, event.place.data());
  return event.placed;
}

// A bone by number, with place, rotation or both from argument `first` on.
Reading bone(const OscMessage& message, int first, std::string_view what, std::uint32_t skeleton,
             double number, const Arrival& arrival, const NatnetNames& names, EventSink& sink) {
  MocapEvent event = event_of(MocapKind::bone, MocapForm::natnet, arrival);
  event.stream = skeleton;
  if (what != "position" && what != "quat" && what != "transformation") return Reading::unknown;
  if (what != "quat" && !places(message, first, event)) return Reading::faulty;
  if (what != "position" && !rotation_in(message, what == "quat" ? first : first + 3, event))
    return Reading::faulty;
  if (!(number >= 0 && number < 10000)) return Reading::faulty;
  event.bone = static_cast<std::int16_t>(names.bone(
      skeleton, static_cast<int>(number), message.number(0) && message.path() == "/skel"));
  if (event.bone < 0) return Reading::unknown;
  sink.take(event);
  return Reading::taken;
}

class NatnetReader final : public FormReader {
 public:
  Reading read(const OscMessage& message, const Arrival& arrival, EventSink& sink) override;

 private:
  NatnetNames names_;
};

Reading NatnetReader::read(const OscMessage& message, const Arrival& arrival, EventSink& sink) {
  std::string_view path = message.path();
  if (path == "/frame/start" || path == "/frame/timecode" || path == "/f/s") return Reading::taken;
  if (path == "/frame/timestamp" || path == "/f/t") {
    const auto number = message.number(0);
    if (!number) return Reading::faulty;
    MocapEvent clock = event_of(MocapKind::clock, MocapForm::natnet, arrival);
    clock.sent = *number;
    sink.take(clock);
    return Reading::taken;
  }
  if (path == "/motive/skeleton/id" || path == "/skeleton/id") {
    const auto name = message.key(0), number = message.key(1);
    if (!name || !number) return Reading::faulty;
    names_.call(*number, *name);
    return Reading::taken;
  }
  if (path == "/frame/end" || path == "/f/e") {
    sink.take(event_of(MocapKind::edge, MocapForm::natnet, arrival));
    return Reading::taken;
  }
  if (path == "/skel") {  // sparck: skeleton, bone, time, place and rotation
    const auto skeleton = message.key(0);
    const auto number = message.number(1);
    if (!skeleton || !number) return Reading::faulty;
    return bone(message, 3, "transformation", *skeleton, *number, arrival, names_, sink);
  }
  if (path == "/motive/skeleton/id/bone" || path == "/skeleton/id/bone") {
    const auto skeleton = message.key(0);
    const auto number = message.number(1);
    const auto name = message.text(2);
    if (!skeleton || !number || !name || !(*number >= 0 && *number < 10000) ||
        name->size() >= MocapEvent::name_size)
      return Reading::faulty;
    names_.set(*skeleton, static_cast<int>(*number), *name);
    return Reading::taken;
  }
  if (path == "/skeleton/bone") {  // max: skeleton, bone, what, numbers
    const auto skeleton = message.key(0);
    const auto number = message.number(1);
    const auto what = message.text(2);
    if (!skeleton || !number || !what) return Reading::faulty;
    return bone(message, 3, *what, *skeleton, *number, arrival, names_, sink);
  }
  if (path.starts_with("/skeleton/")) {  // isadora and touch
    path.remove_prefix(10);
    const Path parts = parts_of(path);
    if (parts.kind != "bone" || parts.what.empty()) return Reading::unknown;
    const auto number = whole_number_in<int>(parts.number);
    if (!number) return Reading::faulty;
    std::uint32_t skeleton = key_of(parts.skeleton);
    // Skeletons have numbers or names.
    if (const auto as_number = whole_number_in<int>(parts.skeleton); as_number && *as_number >= 0)
      skeleton = static_cast<std::uint32_t>(*as_number);
    return bone(message, 0, parts.what, skeleton, *number, arrival, names_, sink);
  }
  return Reading::unknown;
}

}  // namespace

std::unique_ptr<FormReader> natnet_reader() { return std::make_unique<NatnetReader>(); }

}  // namespace gait::osc
