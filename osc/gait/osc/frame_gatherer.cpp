#include "gait/osc/frame_gatherer.h"

#include <algorithm>
#include <cstring>

namespace gait::osc {

namespace {

bool same(const std::array<char, MocapEvent::name_size>& a,
          const std::array<char, MocapEvent::name_size>& b) noexcept {
  return std::strncmp(a.data(), b.data(), a.size()) == 0;
}

int named(const CapturedFrame& frame,
          const std::array<char, MocapEvent::name_size>& name) noexcept {
  for (int i = 0; i < frame.joints; ++i)
    if (same(frame.named[i].name, name)) return i;
  return -1;
}

}  // namespace

CapturedFrame::CapturedFrame() : named(most_joints) {
  rotations.fill({0, 0, 0, 1});
  places.fill({0, 0, 0});
}

void CapturedFrame::begin(double at) noexcept {
  time = at;
  rotated.reset();
  placed.reset();
  root_told = false;
  values = 0;
  rig_changed = false;
  for (int i = 0; i < joints; ++i) named[i].rotated = named[i].placed = false;
}

bool CapturedFrame::empty() const noexcept {
  if (rotated.any() || placed.any() || values > 0) return false;
  return std::none_of(named.begin(), named.begin() + joints,
                      [](const NamedJoint& joint) { return joint.rotated; });
}

FrameGatherer::FrameGatherer(int performers) : slots_(static_cast<std::size_t>(performers)) {}

int FrameGatherer::slot_of(const MocapEvent& event) noexcept {
  int free = -1;  // an unused slot, else the one that has been silent for longest
  for (int i = 0; i < performers(); ++i) {
    const Slot& slot = slots_[i];
    if (slot.used && slot.frame.sender == event.sender && slot.frame.stream == event.stream &&
        slot.frame.form == event.form)
      return i;
    if (slot.used && event.time - slot.seen <= silence) continue;
    const auto since = [this](int at) { return slots_[at].used ? slots_[at].seen : -1e300; };
    if (free < 0 || since(i) < since(free)) free = i;
  }
  if (free < 0 || event.kind == MocapKind::edge) return -1;
  Slot& slot = slots_[free];
  slot.used = true;
  slot.frame.form = event.form;
  slot.frame.sender = event.sender;
  slot.frame.stream = event.stream;
  slot.frame.joints = 0;
  slot.frame.begin(event.time);
  return free;
}

bool FrameGatherer::told_already(const CapturedFrame& frame,
                                 const MocapEvent& event) const noexcept {
  switch (event.kind) {
    case MocapKind::bone:
      return (event.rotated && frame.rotated[event.bone]) ||
             (event.placed && frame.placed[event.bone]);
    case MocapKind::root:
      return frame.root_told;
    case MocapKind::values:
      return event.first < frame.values;
    case MocapKind::joint: {
      const int joint = named(frame, event.name);
      return joint >= 0 && frame.named[joint].rotated;
    }
    default:
      return false;
  }
}

void FrameGatherer::take(const MocapEvent& event, FrameSink& sink) noexcept {
  if (event.kind == MocapKind::edge) {
    for (int i = 0; i < performers(); ++i)
      if (slots_[i].used && slots_[i].frame.sender == event.sender &&
          slots_[i].frame.form == event.form)
        end(i, sink);
    return;
  }
  const int at = slot_of(event);
  if (at < 0) {
    ++refused_;
    return;
  }
  if (told_already(slots_[at].frame, event)) end(at, sink);
  apply(slots_[at], event);
}

void FrameGatherer::end(int slot, FrameSink& sink) noexcept {
  CapturedFrame& frame = slots_[slot].frame;
  if (!frame.empty()) {
    sink.frame(slot, frame);
    frame.begin(frame.time);
  } else {
    frame.root_told = false;
  }
}

void FrameGatherer::end_old(double now, FrameSink& sink) noexcept {
  for (int i = 0; i < performers(); ++i)
    if (slots_[i].used && now - slots_[i].frame.time > patience && !slots_[i].frame.empty())
      end(i, sink);
}

void FrameGatherer::apply(Slot& slot, const MocapEvent& event) noexcept {
  CapturedFrame& frame = slot.frame;
  if (event.time - slot.seen > silence) frame.joints = 0;  // may have another rig by now
  slot.seen = event.time;
  if (frame.empty() && !frame.root_told) frame.time = event.time;
  switch (event.kind) {
    case MocapKind::bone:
      if (event.rotated) {
        frame.rotated.set(event.bone);
        frame.rotations[event.bone] = event.rotation;
      }
      if (event.placed) {
        frame.placed.set(event.bone);
        frame.places[event.bone] = event.place;
      }
      break;
    case MocapKind::root:
      frame.root_told = true;
      frame.root = event.place;
      frame.root_rotation = event.rotation;
      frame.heading = event.numbers[0];
      break;
    case MocapKind::values:
      if (event.first == frame.values && event.first + event.count <= most_values) {
        std::copy_n(event.numbers.begin(), event.count, frame.numbers.begin() + event.first);
        frame.values = event.first + event.count;
      }
      break;
    case MocapKind::joint:
    case MocapKind::rig:
      apply_joint(frame, event);
      break;
    case MocapKind::edge:
      break;
  }
}

void FrameGatherer::apply_joint(CapturedFrame& frame, const MocapEvent& event) noexcept {
  int at = named(frame, event.name);
  if (at < 0) {
    if (frame.joints == most_joints) {
      ++refused_;
      return;
    }
    at = frame.joints++;
    frame.named[at] = {};
    frame.named[at].name = event.name;
    frame.rig_changed = true;
  }
  NamedJoint& joint = frame.named[at];
  if (event.kind == MocapKind::rig) {
    joint.rigged = true;
    joint.parent = event.parent;
    joint.offset = event.place;
    joint.above = event.parent[0] == '\0' ? -1 : named(frame, event.parent);
    return;
  }
  joint.rotated = true;
  joint.relative = event.relative;
  joint.rotation = event.rotation;
  std::copy_n(event.numbers.begin(), 3, joint.vector.begin());
  joint.placed = event.placed;
  if (event.placed) joint.place = event.place;
}

}  // namespace gait::osc
