// MediaPipe's landmarks over OSC, in the forms that bridges use; none is a standard:
//   /mediapipe/pose [i 1] then 33 times x y z [visibility] (cansik/mediapipe-osc; i 0: none is
//   seen) /pose/INDEX, /pose/INDEX/xyz, /pose/NAME  x y z [visibility]
// and the packer of the first one.
#include "gait/numbers.h"
#include "gait/osc/mediapipe_landmarks.h"
#include "gait/osc/osc_packer.h"
#include "gait/osc/packers.h"
#include "gait/osc/readers.h"
#include "gait/osc/world_bones.h"

namespace gait::osc {

namespace {

constexpr float least_visibility = 0.5F;

// Landmarks that come one by one.
struct Gathered {
  Landmarks landmarks;
  int last = -1;
};

void tell_body(const Landmarks& landmarks, const Arrival& arrival, EventSink& sink) {
  HumanoidPose pose;
  body_of(landmarks, pose);
  for (int bone = 0; bone < main_bones; ++bone) {
    const auto at = static_cast<std::size_t>(bone);
    if (pose.turned[at])
      tell_bone(MocapForm::mediapipe, arrival, 0, bone, pose.turns[at],
                pose.placed[at] ? &pose.places[at] : nullptr, sink);
  }
  tell_end(MocapForm::mediapipe, arrival, not_sent, sink);
}

class MediapipeReader final : public FormReader {
 public:
  using FormReader::read;
  Reading read(const OscMessage& message, const Arrival& arrival, EventSink& sink) override {
    std::string_view path = message.path();
    if (path == "/mediapipe/pose") return read_all(message, arrival, sink);
    if (!path.starts_with("/pose/")) return Reading::unknown;
    path.remove_prefix(6);
    if (path.ends_with("/xyz")) path.remove_suffix(4);
    const auto number = whole_number_in<int>(path);
    const int landmark =
        number && *number >= 0 && *number < mediapipe_landmarks ? *number : landmark_named(path);
    if (landmark < 0) return Reading::unknown;
    std::array<float, 4> x{0, 0, 0, 1};
    if (message.size() < 3 || message.size() > 4 || !message.numbers(0, message.size(), x.data()))
      return Reading::faulty;
    Gathered& gathered = gathered_.of(arrival.sender);
    // They come in order: a smaller one begins the next frame.
    if (landmark <= gathered.last) {
      tell_body(gathered.landmarks, arrival, sink);
      gathered.landmarks.seen.reset();
    }
    gathered.last = landmark;
    put(gathered.landmarks, landmark, x);
    if (landmark == mediapipe_landmarks - 1) {
      tell_body(gathered.landmarks, arrival, sink);
      gathered.landmarks.seen.reset();
      gathered.last = -1;
    }
    return Reading::taken;
  }

 private:
  static void put(Landmarks& landmarks, int landmark, const std::array<float, 4>& x) {
    const auto at = static_cast<std::size_t>(landmark);
    landmarks.places[at] = {double{x[0]}, double{x[1]}, double{x[2]}};
    landmarks.seen[at] = x[3] >= least_visibility;
  }

  static Reading read_all(const OscMessage& message, const Arrival& arrival, EventSink& sink) {
    const int first = message.size() % mediapipe_landmarks;
    const int stride = message.size() / mediapipe_landmarks;
    if (message.size() == 1) return message.number(0) ? Reading::taken : Reading::faulty;
    if (first > 1 || (stride != 3 && stride != 4)) return Reading::faulty;
    Landmarks landmarks;
    for (int i = 0; i < mediapipe_landmarks; ++i) {
      std::array<float, 4> x{0, 0, 0, 1};
      if (!message.numbers(first + stride * i, stride, x.data())) return Reading::faulty;
      put(landmarks, i, x);
    }
    if (first == 1) {
      const auto people = message.number(0);
      if (!people) return Reading::faulty;
      if (*people == 0) return Reading::taken;
    }
    tell_body(landmarks, arrival, sink);
    return Reading::taken;
  }

  PerSender<Gathered> gathered_;
};

class MediapipePacker final : public OscPacker {
 public:
  MediapipePacker() {
    add_message("/mediapipe/pose", "i" + std::string(4 * mediapipe_landmarks, 'f'));
    laid_out();
  }
  void pack(const HumanoidPose& pose, double, int) noexcept override {
    Landmarks landmarks;
    landmarks_of(pose, landmarks);
    begin();
    add(1);
    for (const Eigen::Vector3d& place : landmarks.places) {
      add(place);
      add(1);
    }
    end();
  }
};

}  // namespace

std::unique_ptr<FormReader> mediapipe_reader() { return std::make_unique<MediapipeReader>(); }
std::unique_ptr<FormPacker> mediapipe_packer(const std::vector<int>&) {
  return std::make_unique<MediapipePacker>();
}

}  // namespace gait::osc
