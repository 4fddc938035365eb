// NatNetThree2OSC (github.com/tecartlab/app_NatNetThree2OSC, 6.0 to 9.1), from OptiTrack Motive:
// skeletons in its four modes, right-handed, Y up, metres. Rigid bodies and markers are passed
// over.

#include "gait/motion/humanoid.h"
#include "gait/numbers.h"
#include "gait/osc/mocap_reader.h"

namespace gait::osc {

namespace {

// Motive's Baseline skeleton, numbered from 1; for bridges that have sent no names.
constexpr std::array<Bone, 21> usual_numbers{Bone::hips,
                                             Bone::spine,
                                             Bone::chest,
                                             Bone::neck,
                                             Bone::head,
                                             Bone::left_shoulder,
                                             Bone::left_upper_arm,
                                             Bone::left_lower_arm,
                                             Bone::left_hand,
                                             Bone::right_shoulder,
                                             Bone::right_upper_arm,
                                             Bone::right_lower_arm,
                                             Bone::right_hand,
                                             Bone::left_upper_leg,
                                             Bone::left_lower_leg,
                                             Bone::left_foot,
                                             Bone::right_upper_leg,
                                             Bone::right_lower_leg,
                                             Bone::right_foot,
                                             Bone::left_toes,
                                             Bone::right_toes};

// Names of that skeleton with another meaning elsewhere.
int motive_bone(std::string_view name) {
  if (const std::size_t owner = name.rfind('_'); owner != std::string_view::npos)
    name.remove_prefix(owner + 1);
  if (name == "Ab") return index_of(Bone::spine);
  if (name == "Chest") return index_of(Bone::chest);
  return bone_named(name);
}

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
             double number, const Arrival& arrival, const BoneNumbers& numbers, EventSink& sink) {
  MocapEvent event = event_of(MocapKind::bone, MocapForm::natnet, arrival);
  event.stream = skeleton;
  if (what != "position" && what != "quat" && what != "transformation") return Reading::unknown;
  if (what != "quat" && !places(message, first, event)) return Reading::faulty;
  if (what != "position" && !rotation_in(message, what == "quat" ? first : first + 3, event))
    return Reading::faulty;
  if (!(number >= 0 && number < 10000)) return Reading::faulty;
  event.bone = static_cast<std::int16_t>(numbers.bone(skeleton, static_cast<int>(number)));
  if (event.bone < 0) return Reading::unknown;
  sink.take(event);
  return Reading::taken;
}

}  // namespace

void BoneNumbers::set(std::uint32_t skeleton, int number, int bone) noexcept {
  for (Entry& entry : entries_)
    if (entry.skeleton == skeleton && entry.number == number) {
      entry.bone = bone;
      return;
    }
  entries_[next_] = {skeleton, number, bone};
  next_ = (next_ + 1) % entries_.size();
}

int BoneNumbers::bone(std::uint32_t skeleton, int number) const noexcept {
  for (const Entry& entry : entries_)
    if (entry.number == number && entry.skeleton == skeleton) return entry.bone;
  if (number < 1 || number > static_cast<int>(usual_numbers.size())) return -1;
  return index_of(usual_numbers[static_cast<std::size_t>(number - 1)]);
}

Reading read_natnet(const OscMessage& message, const Arrival& arrival, BoneNumbers& numbers,
                    EventSink& sink) {
  std::string_view path = message.path();
  if (path == "/frame/end" || path == "/f/e") {
    sink.take(event_of(MocapKind::edge, MocapForm::natnet, arrival));
    return Reading::taken;
  }
  if (path == "/skel") {  // sparck: skeleton, bone, time, place and rotation
    const auto skeleton = message.key(0);
    const auto number = message.number(1);
    if (!skeleton || !number) return Reading::faulty;
    return bone(message, 3, "transformation", *skeleton, *number, arrival, numbers, sink);
  }
  if (path == "/motive/skeleton/id/bone" || path == "/skeleton/id/bone") {
    const auto skeleton = message.key(0);
    const auto number = message.number(1);
    const auto name = message.text(2);
    if (!skeleton || !number || !name || !(*number >= 0 && *number < 10000) ||
        name->size() >= MocapEvent::name_size)
      return Reading::faulty;
    numbers.set(*skeleton, static_cast<int>(*number), motive_bone(*name));
    return Reading::taken;
  }
  if (path == "/skeleton/bone") {  // max: skeleton, bone, what, numbers
    const auto skeleton = message.key(0);
    const auto number = message.number(1);
    const auto what = message.text(2);
    if (!skeleton || !number || !what) return Reading::faulty;
    return bone(message, 3, *what, *skeleton, *number, arrival, numbers, sink);
  }
  if (path.starts_with("/skeleton/")) {  // isadora and touch
    path.remove_prefix(10);
    const Path parts = parts_of(path);
    if (parts.kind != "bone" || parts.what.empty()) return Reading::unknown;
    const auto number = whole_number_in<int>(parts.number);
    if (!number) return Reading::faulty;
    std::uint32_t skeleton = key_of(parts.skeleton);
    // Skeletons have numbers or names; the names of bones came with the same key.
    if (const auto as_number = whole_number_in<int>(parts.skeleton); as_number && *as_number >= 0)
      skeleton = static_cast<std::uint32_t>(*as_number);
    return bone(message, 0, parts.what, skeleton, *number, arrival, numbers, sink);
  }
  return Reading::unknown;
}

}  // namespace gait::osc
