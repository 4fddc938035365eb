// Sony mocopi's own stream over UDP ("sony motion format"): boxes of a length, a name of four
// letters and a value, little-endian. `skdf` tells the skeleton, `fram` a frame; each rotation is
// relative to the parent.
#include <array>
#include <cmath>
#include <cstring>

#include "gait/motion/humanoid.h"
#include "gait/osc/mocopi_joints.h"
#include "gait/osc/readers.h"
#include "gait/osc/wire.h"
#include "gait/osc/world_bones.h"

namespace gait::osc {

namespace {

using Bytes = std::span<const std::byte>;

struct Transform {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};
using Joints = std::array<Transform, mocopi_joints>;

// A skeleton as its sender told it, and the joints' rotations of its last frame.
struct MocopiRig {
  std::array<int, mocopi_joints> parents{};
  Joints rest, now;
  bool counted = false;
  std::uint32_t frame = 0;

  MocopiRig() {
    for (int joint = 0; joint < mocopi_joints; ++joint) {
      parents[static_cast<std::size_t>(joint)] = mocopi_parent(joint);
      rest[static_cast<std::size_t>(joint)].place = mocopi_offset(joint);
    }
    now = rest;
  }
};

struct Box {
  std::string_view name;
  Bytes value;
};

// The next box of `rest`; false at its end or, with `faulty` set, where there is none.
bool next_box(Bytes& rest, Box& box, bool& faulty) {
  if (rest.empty()) return false;
  if (rest.size() < 8 || number_at<std::uint32_t, std::endian::little>(rest, 0) > rest.size() - 8) {
    faulty = true;
    return false;
  }
  const auto length = number_at<std::uint32_t, std::endian::little>(rest, 0);
  box.name = {reinterpret_cast<const char*>(rest.data()) + 4, 4};
  box.value = rest.subspan(8, length);
  rest = rest.subspan(8 + length);
  return true;
}

template <typename T>
bool number_in(const Box& box, T& number) {
  if (box.value.size() < sizeof(T)) return false;
  number = number_at<T, std::endian::little>(box.value, 0);
  return true;
}

bool transform_in(const Box& box, Transform& transform) {
  if (box.value.size() != 28) return false;
  std::array<double, 7> x;
  for (std::size_t i = 0; i < 7; ++i) {
    x[i] = double{number_at<float, std::endian::little>(box.value, 4 * i)};
    if (!std::isfinite(x[i]) || std::abs(x[i]) > 1e6) return false;
  }
  const Eigen::Quaterniond q(x[3], x[0], x[1], x[2]);
  if (q.norm() < 1e-3) return false;
  transform.rotation = q.normalized();
  transform.place = {x[4], x[5], x[6]};
  return true;
}

// A `bndt` or `btdt`. Joints beyond those that are known are passed over: `joint` is then -1.
bool joint_in(Bytes bytes, int& joint, int& parent, Transform& transform) {
  bool faulty = false, numbered = false, moved = false;
  Box box;
  std::uint16_t number = 0;
  joint = parent = -1;
  while (next_box(bytes, box, faulty)) {
    if (box.name == "bnid") {
      if (!number_in(box, number)) return false;
      numbered = true;
      joint = number < mocopi_joints ? number : -1;
    } else if (box.name == "pbid") {
      if (!number_in(box, number)) return false;
      parent = number == 0xFFFF ? -1 : number;
    } else if (box.name == "tran") {
      moved = transform_in(box, transform);
      if (!moved) return false;
    }
  }
  return numbered && moved && !faulty;
}

class MocopiReader final : public FormReader {
 public:
  using FormReader::read;
  Reading read(Bytes datagram, const Arrival& arrival, EventSink& sink) override {
    if (datagram.size() < 8 || std::memcmp(datagram.data() + 4, "head", 4) != 0)
      return Reading::unknown;
    bool faulty = false, taken = false;
    Box box;
    while (next_box(datagram, box, faulty)) {
      if (box.name == "head" && !is_motion(box.value)) return Reading::faulty;
      if (box.name == "skdf") {
        if (!read_skeleton(box.value, rigs_.of(arrival.sender))) return Reading::faulty;
        taken = true;
      } else if (box.name == "fram") {
        if (!read_frame(box.value, rigs_.of(arrival.sender), arrival, sink)) return Reading::faulty;
        taken = true;
      }
    }
    return taken && !faulty ? Reading::taken : Reading::faulty;
  }

 private:
  static bool is_motion(Bytes head) {
    bool faulty = false;
    Box box;
    while (next_box(head, box, faulty))
      if (box.name == "ftyp")
        return std::string_view(reinterpret_cast<const char*>(box.value.data()),
                                box.value.size()) == "sony motion format";
    return false;
  }

  static bool read_skeleton(Bytes skeleton, MocopiRig& rig) {
    MocopiRig told = rig;
    bool faulty = false;
    Box list, bone;
    while (next_box(skeleton, list, faulty)) {
      if (list.name != "bons") continue;
      while (next_box(list.value, bone, faulty)) {
        int joint = 0, parent = 0;
        Transform rest;
        if (bone.name != "bndt") continue;
        // Parents come before children.
        if (!joint_in(bone.value, joint, parent, rest) || parent >= joint) return false;
        if (joint < 0) continue;
        told.parents[static_cast<std::size_t>(joint)] = parent;
        told.rest[static_cast<std::size_t>(joint)] = rest;
      }
    }
    if (faulty) return false;
    rig = told;
    return true;
  }

  static bool read_frame(Bytes frame, MocopiRig& rig, const Arrival& arrival, EventSink& sink) {
    Joints now = rig.now;
    bool faulty = false, counted = false;
    std::uint32_t count = 0;
    double sent = not_sent;
    std::bitset<mocopi_joints> came;
    Box box, bone;
    while (next_box(frame, box, faulty)) {
      if (box.name == "fnum") counted = number_in(box, count);
      if (box.name == "uttm" && (!number_in(box, sent) || !std::isfinite(sent))) sent = not_sent;
      if (box.name != "btrs") continue;
      while (next_box(box.value, bone, faulty)) {
        int joint = 0, parent = 0;
        Transform moved;
        if (bone.name != "btdt") continue;
        if (!joint_in(bone.value, joint, parent, moved)) return false;
        if (joint < 0) continue;
        now[static_cast<std::size_t>(joint)] = moved;
        came.set(static_cast<std::size_t>(joint));
      }
    }
    if (faulty || came.none()) return false;
    rig.now = now;
    // One that another one has overtaken; a count far from the last is of a new start.
    const std::uint32_t behind = rig.frame - count;
    const bool overtaken = counted && rig.counted && behind < 8;
    if (overtaken) return true;
    rig.counted = counted;
    rig.frame = count;
    tell(rig, came, sent, arrival, sink);
    return true;
  }

  static void tell(const MocopiRig& rig, const std::bitset<mocopi_joints>& came, double sent,
                   const Arrival& arrival, EventSink& sink) {
    Joints world, rest;
    for (int joint = 0; joint < mocopi_joints; ++joint) {
      const auto at = static_cast<std::size_t>(joint);
      const int parent = rig.parents[at];
      world[at] = rig.now[at];
      rest[at].rotation = rig.rest[at].rotation;
      if (parent >= 0) {
        const Transform& above = world[static_cast<std::size_t>(parent)];
        world[at].rotation = (above.rotation * rig.now[at].rotation).normalized();
        world[at].place = above.place + above.rotation * rig.rest[at].place;
        rest[at].rotation = rest[static_cast<std::size_t>(parent)].rotation * rig.rest[at].rotation;
      }
      const int bone = mocopi_bone(joint);
      if (bone < 0 || !came[at]) continue;
      tell_bone(MocapForm::mocopi, arrival, 0, bone,
                world[at].rotation * rest[at].rotation.conjugate(), &world[at].place, sink);
    }
    tell_end(MocapForm::mocopi, arrival, sent, sink);
  }

  PerSender<MocopiRig> rigs_;
};

}  // namespace

std::unique_ptr<FormReader> mocopi_reader() { return std::make_unique<MocopiReader>(); }

}  // namespace gait::osc
