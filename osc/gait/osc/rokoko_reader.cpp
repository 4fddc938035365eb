// Rokoko Studio's live stream: one JSON document in a datagram, versions 2, 2.5 and 3. Rotations
// and places are in the world, in Unity's axes. A compressed stream (an LZ4 frame) is recognised.
#include <cmath>
#include <nlohmann/json.hpp>

#include "gait/motion/humanoid.h"
#include "gait/osc/readers.h"
#include "gait/osc/rokoko_joints.h"
#include "gait/osc/wire.h"
#include "gait/osc/world_bones.h"

namespace gait::osc {

namespace {

using Json = nlohmann::json;

// Metres, in documents and in old examples centimetres: no hip is ten metres high.
constexpr double highest_hip = 10;

const Json* member(const Json& object, const char* name) {
  if (!object.is_object()) return nullptr;
  const auto at = object.find(name);
  return at == object.end() ? nullptr : &*at;
}

bool number_in(const Json& object, const char* name, double& number) {
  const Json* found = member(object, name);
  if (!found || !found->is_number()) return false;
  number = found->get<double>();
  return std::isfinite(number) && std::abs(number) < 1e6;
}

struct JointNow {
  int bone;
  Eigen::Quaterniond turn;
  Eigen::Vector3d place;
};

bool joint_in(const Json& joint, JointNow& now) {
  const Json *place = member(joint, "position"), *rotation = member(joint, "rotation");
  if (!place || !rotation) return false;
  for (int i = 0; i < 3; ++i)
    if (constexpr const char* names[] = {"x", "y", "z"}; !number_in(*place, names[i], now.place[i]))
      return false;
  Eigen::Quaterniond& q = now.turn;
  return number_in(*rotation, "x", q.x()) && number_in(*rotation, "y", q.y()) &&
         number_in(*rotation, "z", q.z()) && number_in(*rotation, "w", q.w()) && q.norm() > 1e-3;
}

bool said_false(const Json* meta, const char* name) {
  const Json* found = meta ? member(*meta, name) : nullptr;
  return found && found->is_boolean() && !found->get<bool>();
}

class RokokoReader final : public FormReader {
 public:
  using FormReader::read;
  Reading read(std::span<const std::byte> datagram, const Arrival& arrival,
               EventSink& sink) override {
    if (datagram.size() >= 4 &&
        number_at<std::uint32_t, std::endian::little>(datagram, 0) == 0x184D2204) {
      MocapEvent notice = event_of(MocapKind::notice, MocapForm::rokoko, arrival);
      notice.first = static_cast<std::int16_t>(Notice::rokoko_compressed);
      sink.take(notice);
      return Reading::faulty;
    }
    if (datagram.empty() || datagram[0] != std::byte{'{'}) return Reading::unknown;
    const auto* text = reinterpret_cast<const char*>(datagram.data());
    const Json document = Json::parse(text, text + datagram.size(), nullptr, false);
    if (document.is_discarded()) return Reading::faulty;
    const Json* scene = member(document, "scene");
    const Json& frame = scene ? *scene : document;
    const Json* actors = member(frame, "actors");
    if (!actors) return Reading::unknown;
    if (!actors->is_array() || actors->size() > most_actors) return Reading::faulty;
    std::vector<std::vector<JointNow>> bodies;
    for (const Json& actor : *actors)
      if (!read_actor(actor, bodies.emplace_back())) return Reading::faulty;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (const JointNow& joint : bodies[i])
        tell_bone(MocapForm::rokoko, arrival, static_cast<std::uint32_t>(i), joint.bone,
                  mirrored(joint.turn), &joint.place, sink);
    double sent = not_sent;
    if (!number_in(frame, "timestamp", sent)) sent = not_sent;
    tell_end(MocapForm::rokoko, arrival, sent, sink);
    return Reading::taken;
  }

 private:
  static constexpr std::size_t most_actors = 16;

  static bool read_actor(const Json& actor, std::vector<JointNow>& joints) {
    const Json* meta = member(actor, "meta");
    if (!actor.is_object()) return false;
    if (said_false(meta, "hasBody")) return true;
    const Json* body = member(actor, "body");
    const Json& all = body ? *body : actor;  // version 2 has joints in the actor itself
    if (!all.is_object()) return false;
    double unit = 1;
    for (const auto& [name, value] : all.items()) {
      JointNow joint{rokoko_bone(name), {}, {}};
      if (joint.bone < 0) continue;
      // Joints of fingers are there without gloves.
      const bool left = joint.bone < index_of(Bone::right_fingers);
      if (joint.bone >= index_of(Bone::left_fingers) &&
          (said_false(meta, "hasGloves") ||
           said_false(meta, left ? "hasLeftGlove" : "hasRightGlove")))
        continue;
      if (!joint_in(value, joint)) return false;
      if (joint.bone == 0 && joint.place.y() > highest_hip) unit = 0.01;
      joint.turn = joint.turn.normalized() * rokoko_t_pose(joint.bone).conjugate();
      joints.push_back(joint);
    }
    for (JointNow& joint : joints) joint.place = unit * mirrored(joint.place);
    std::ranges::sort(joints, {}, &JointNow::bone);
    return true;
  }
};

}  // namespace

std::unique_ptr<FormReader> rokoko_reader() { return std::make_unique<RokokoReader>(); }

}  // namespace gait::osc
