#include "gait/osc/captured_frame.h"

#include <algorithm>
#include <cstring>

namespace gait::osc {

namespace {

bool same(const std::array<char, MocapEvent::name_size>& a,
          const std::array<char, MocapEvent::name_size>& b) noexcept {
  return std::strncmp(a.data(), b.data(), a.size()) == 0;
}

int named_as(const CapturedFrame& frame,
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
  sent = not_sent;
  begun = false;
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

bool CapturedFrame::contains(const MocapEvent& event) const noexcept {
  switch (event.kind) {
    case MocapKind::bone:
      return (event.rotated && rotated[event.bone]) || (event.placed && placed[event.bone]);
    case MocapKind::root:
      return root_told;
    case MocapKind::values:
      return event.first < values;
    case MocapKind::joint: {
      const int joint = named_as(*this, event.name);
      return joint >= 0 && named[joint].rotated;
    }
    default:
      return false;
  }
}

bool CapturedFrame::take(const MocapEvent& event) noexcept {
  switch (event.kind) {
    case MocapKind::bone:
      if (event.rotated) {
        rotated.set(event.bone);
        rotations[event.bone] = event.rotation;
      }
      if (event.placed) {
        placed.set(event.bone);
        places[event.bone] = event.place;
      }
      break;
    case MocapKind::root:
      root_told = true;
      root = event.place;
      root_rotation = event.rotation;
      heading = event.numbers[0];
      break;
    case MocapKind::values:
      if (event.first == values && event.first + event.count <= most_values) {
        std::copy_n(event.numbers.begin(), event.count, numbers.begin() + event.first);
        values = event.first + event.count;
      }
      break;
    case MocapKind::joint:
    case MocapKind::rig:
      return take_joint(event);
    case MocapKind::clock:
    case MocapKind::notice:
    case MocapKind::plain:
    case MocapKind::edge:
      break;
  }
  return true;
}

bool CapturedFrame::take_joint(const MocapEvent& event) noexcept {
  int at = named_as(*this, event.name);
  if (at < 0) {
    if (joints == most_joints) return false;
    at = joints++;
    named[at] = {};
    named[at].name = event.name;
    rig_changed = true;
  }
  NamedJoint& joint = named[at];
  if (event.kind == MocapKind::rig) {
    joint.rigged = true;
    joint.parent = event.parent;
    joint.offset = event.place;
    joint.above = event.parent[0] == '\0' ? -1 : named_as(*this, event.parent);
    return true;
  }
  joint.rotated = true;
  joint.relative = event.relative;
  joint.rotation = event.rotation;
  std::copy_n(event.numbers.begin(), 3, joint.vector.begin());
  joint.placed = event.placed;
  if (event.placed) joint.place = event.place;
  return true;
}

}  // namespace gait::osc
