// OSCeleton and its kin for the Kinect: places of joints by name.
//   Zillode's for SDK 1 and 2: /joint, /osceleton2/joint, s i i f f f f d: name, sensor, user,
//   centimetres, confidence, time.
//   Sensebloom's: /joint s i f f f: name, user, place between 0 and 1 (depth to 7.8); the program
//   reckons x = (1280 - X) / 2560, y = (960 - Y) / 1920, z = Z / 1280 of millimetres.
// Wrists are ignored, as hands are always sent. SenderPose finds out the directions of X and Y.
#include "gait/motion/humanoid.h"
#include "gait/osc/readers.h"

namespace gait::osc {

namespace {

struct Named {
  std::string_view name;
  Bone bone;
};

constexpr std::array<Named, 15> joints{{
    {"head", Bone::head},
    {"neck", Bone::neck},
    {"torso", Bone::spine},
    {"l_shoulder", Bone::left_upper_arm},
    {"l_elbow", Bone::left_lower_arm},
    {"l_hand", Bone::left_hand},
    {"r_shoulder", Bone::right_upper_arm},
    {"r_elbow", Bone::right_lower_arm},
    {"r_hand", Bone::right_hand},
    {"l_hip", Bone::left_upper_leg},
    {"l_knee", Bone::left_lower_leg},
    {"l_ankle", Bone::left_foot},
    {"r_hip", Bone::right_upper_leg},
    {"r_knee", Bone::right_lower_leg},
    {"r_ankle", Bone::right_foot},
}};

}  // namespace

Reading read_kinect(const OscMessage& message, const Arrival& arrival, EventSink& sink) {
  if (message.path() != "/joint" && message.path() != "/osceleton2/joint") return Reading::unknown;
  const bool centimetres = message.size() >= 7;
  const auto name = message.text(0);
  const auto user = message.key(centimetres ? 2 : 1);
  MocapEvent event = event_of(MocapKind::bone, MocapForm::kinect, arrival);
  if (!name || !user || !message.numbers(centimetres ? 3 : 2, 3, event.place.data()))
    return Reading::faulty;
  event.stream = *user;
  event.placed = true;
  const bool nowhere = event.place == std::array<float, 3>{};
  if (centimetres) {
    const auto confidence = message.number(6);
    if (!confidence) return Reading::faulty;
    if (nowhere || *confidence <= 0) return Reading::taken;  // not seen
    for (float& x : event.place) x /= 100;
  } else {
    if (nowhere) return Reading::taken;
    event.place = {1.28F - 2.56F * event.place[0], 0.96F - 1.92F * event.place[1],
                   1.28F * event.place[2]};
  }
  if (*name == "l_foot") event.bone = index_of(Bone::left_toes);
  if (*name == "r_foot") event.bone = index_of(Bone::right_toes);
  for (const Named& joint : joints)
    if (joint.name == *name) event.bone = static_cast<std::int16_t>(index_of(joint.bone));
  if (event.bone < 0) return Reading::unknown;
  sink.take(event);
  return Reading::taken;
}

}  // namespace gait::osc
