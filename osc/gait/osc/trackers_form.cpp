// VRChat's OSC trackers, as SlimeVR sends them: places and Euler angles (degrees, R = Ry Rx Rz) of
// up to eight trackers and the head, left-handed. A tracker at a knee or elbow turns as the bone
// above it does. Which tracker is where is SlimeVR's order.
#include <cmath>
#include <numbers>

#include "gait/motion/rotation.h"
#include "gait/osc/osc_packer.h"
#include "gait/osc/packers.h"
#include "gait/osc/readers.h"
#include "gait/osc/world_bones.h"

namespace gait::osc {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

struct Tracker {
  std::string_view name;
  Bone turned, placed;
};
constexpr std::array<Tracker, 9> trackers{{{"1", Bone::hips, Bone::hips},
                                           {"2", Bone::left_foot, Bone::left_foot},
                                           {"3", Bone::right_foot, Bone::right_foot},
                                           {"4", Bone::left_upper_leg, Bone::left_lower_leg},
                                           {"5", Bone::right_upper_leg, Bone::right_lower_leg},
                                           {"6", Bone::chest, Bone::chest},
                                           {"7", Bone::left_upper_arm, Bone::left_lower_arm},
                                           {"8", Bone::right_upper_arm, Bone::right_lower_arm},
                                           {"head", Bone::head, Bone::head}}};

// A bone that no tracker turns: it points from one place to another, untwisted against the one
// above.
struct Between {
  Bone bone, end, above;
  double x, y;  // where it points in the T-pose
};
constexpr std::array<Between, 4> between{
    {{Bone::left_lower_leg, Bone::left_foot, Bone::left_upper_leg, 0, -1},
     {Bone::right_lower_leg, Bone::right_foot, Bone::right_upper_leg, 0, -1},
     {Bone::left_lower_arm, Bone::left_hand, Bone::left_upper_arm, 1, 0},
     {Bone::right_lower_arm, Bone::right_hand, Bone::right_upper_arm, -1, 0}}};

Eigen::Quaterniond from_degrees(const float* xyz) {
  const auto about = [&](int axis, const Eigen::Vector3d& unit) {
    return Eigen::AngleAxisd(double{xyz[axis]} / degrees, unit);
  };
  return mirrored(
      Eigen::Quaterniond(about(1, Eigen::Vector3d::UnitY()) * about(0, Eigen::Vector3d::UnitX()) *
                         about(2, Eigen::Vector3d::UnitZ())));
}

Eigen::Vector3d to_degrees(const Eigen::Quaterniond& turn) {
  const Eigen::Matrix3d r = mirrored(turn).toRotationMatrix();
  const double x = std::asin(std::clamp(-r(1, 2), -1.0, 1.0));
  return degrees * Eigen::Vector3d(x, std::atan2(r(0, 2), r(2, 2)), std::atan2(r(1, 0), r(1, 1)));
}

class TrackersReader final : public FormReader {
 public:
  using FormReader::read;
  Reading read(const OscMessage& message, const Arrival& arrival, EventSink& sink) override {
    std::string_view path = message.path();
    std::array<float, 6> x{};
    if (path.starts_with("/tracking/vrsystem/")) {
      if (!message.numbers(0, 6, x.data())) return Reading::faulty;
      HumanoidPose& pose = poses_.of(arrival.sender);
      if (path == "/tracking/vrsystem/head/pose") {
        tell_place(Bone::head, x.data(), pose, arrival, sink);
        tell_turn(Bone::head, x.data() + 3, pose, arrival, sink);
      } else if (path == "/tracking/vrsystem/leftwrist/pose") {
        tell_place(Bone::left_hand, x.data(), pose, arrival, sink);
      } else if (path == "/tracking/vrsystem/rightwrist/pose") {
        tell_place(Bone::right_hand, x.data(), pose, arrival, sink);
      } else {
        return Reading::unknown;
      }
      return Reading::taken;
    }
    if (!path.starts_with("/tracking/trackers/")) return Reading::unknown;
    path.remove_prefix(19);
    const std::size_t slash = path.find('/');
    const std::string_view what = path.substr(std::min(path.size(), slash + 1));
    const auto tracker = std::ranges::find(trackers, path.substr(0, slash), &Tracker::name);
    if (tracker == trackers.end() || (what != "position" && what != "rotation"))
      return Reading::unknown;
    if (!message.numbers(0, 3, x.data())) return Reading::faulty;
    HumanoidPose& pose = poses_.of(arrival.sender);
    if (what == "position")
      tell_place(tracker->placed, x.data(), pose, arrival, sink);
    else
      tell_turn(tracker->turned, x.data(), pose, arrival, sink);
    return Reading::taken;
  }

 private:
  static void tell_turn(Bone bone, const float* x, HumanoidPose& pose, const Arrival& arrival,
                        EventSink& sink) {
    pose.turned.set(index_of(bone));
    pose.turns[index_of(bone)] = from_degrees(x);
    tell_bone(MocapForm::trackers, arrival, 0, index_of(bone), pose.turns[index_of(bone)], nullptr,
              sink);
    tell_between(bone, pose, arrival, sink);
  }
  static void tell_place(Bone bone, const float* x, HumanoidPose& pose, const Arrival& arrival,
                         EventSink& sink) {
    pose.placed.set(index_of(bone));
    pose.places[index_of(bone)] =
        mirrored(Eigen::Vector3d(double{x[0]}, double{x[1]}, double{x[2]}));
    MocapEvent event = event_of(MocapKind::bone, MocapForm::trackers, arrival);
    event.bone = static_cast<std::int16_t>(index_of(bone));
    event.placed = true;
    for (int i = 0; i < 3; ++i)
      event.place[static_cast<std::size_t>(i)] = static_cast<float>(pose.places[index_of(bone)][i]);
    sink.take(event);
    tell_between(bone, pose, arrival, sink);
  }
  // Bones between others, whenever one of these has changed.
  static void tell_between(Bone changed, HumanoidPose& pose, const Arrival& arrival,
                           EventSink& sink) {
    for (const Between& way : between) {
      if (changed != way.bone && changed != way.end && changed != way.above) continue;
      if (!pose.placed[index_of(way.bone)] || !pose.placed[index_of(way.end)] ||
          !pose.turned[index_of(way.above)])
        continue;
      const Eigen::Quaterniond& carried = pose.turns[index_of(way.above)];
      const Eigen::Vector3d points =
          pose.places[index_of(way.end)] - pose.places[index_of(way.bone)];
      if (points.norm() < 1e-3) continue;
      tell_bone(MocapForm::trackers, arrival, 0, index_of(way.bone),
                turn_between(carried * Eigen::Vector3d(way.x, way.y, 0), points) * carried, nullptr,
                sink);
    }
  }

  PerSender<HumanoidPose> poses_;
};

class TrackersPacker final : public OscPacker {
 public:
  TrackersPacker() {
    for (const Tracker& tracker : trackers) {
      const std::string path = "/tracking/trackers/" + std::string(tracker.name);
      add_message(path + "/position", "fff");
      add_message(path + "/rotation", "fff");
    }
    add_message("/tracking/vrsystem/leftwrist/pose", "ffffff");
    add_message("/tracking/vrsystem/rightwrist/pose", "ffffff");
    laid_out();
  }
  void pack(const HumanoidPose& pose, double, int) noexcept override {
    begin();
    for (const Tracker& tracker : trackers) {
      add(mirrored(place(pose, tracker.placed)));
      add(to_degrees(turn(pose, tracker.turned)));
    }
    for (const Bone hand : {Bone::left_hand, Bone::right_hand}) {
      add(mirrored(place(pose, hand)));
      add(to_degrees(turn(pose, hand)));
    }
    end();
  }

 private:
  static Eigen::Quaterniond turn(const HumanoidPose& pose, Bone bone) noexcept {
    int at = index_of(bone);
    if (!pose.turned[static_cast<std::size_t>(at)]) at = pose.turned_above(at);
    return at < 0 ? Eigen::Quaterniond::Identity() : pose.turns[static_cast<std::size_t>(at)];
  }
  static Eigen::Vector3d place(const HumanoidPose& pose, Bone bone) noexcept {
    int at = index_of(bone);
    while (at >= 0 && !pose.placed[static_cast<std::size_t>(at)]) at = bone_parent(at);
    return at < 0 ? Eigen::Vector3d(0, 0, 0) : pose.places[static_cast<std::size_t>(at)];
  }
};

}  // namespace

std::unique_ptr<FormReader> trackers_reader() { return std::make_unique<TrackersReader>(); }
std::unique_ptr<FormPacker> trackers_packer(const std::vector<int>&) {
  return std::make_unique<TrackersPacker>();
}

}  // namespace gait::osc
