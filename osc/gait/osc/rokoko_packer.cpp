// Packs Rokoko Studio's live JSON, version 3: see rokoko_reader.cpp.
#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>

#include "gait/osc/packers.h"
#include "gait/osc/rokoko_joints.h"

namespace gait::osc {

namespace {

constexpr std::size_t rokoko_bytes = 32768;  // a body with fingers takes 11 kB

class RokokoPacker final : public FormPacker {
 public:
  explicit RokokoPacker(const std::vector<int>& bones) {
    for (const int bone : bones)
      if (std::string name = rokoko_joint(bone); !name.empty())
        joints_.push_back({bone, std::move(name)});
    fingers_ = std::ranges::any_of(
        joints_, [](const Joint& joint) { return joint.bone >= index_of(Bone::left_fingers); });
    datagram_.data.reserve(rokoko_bytes);
  }

  void pack(const HumanoidPose& pose, double time, int) noexcept override {
    datagram_.data.clear();
    add(R"({"version":3,"fps":60,"scene":{"timestamp":)");
    add(time);
    add(R"(,"actors":[{"name":"gait","color":[255,255,255],"meta":{"hasGloves":)");
    add(fingers_ ? "true" : "false");
    add(R"(,"hasBody":true,"hasFace":false},"dimensions":{"totalHeight":)");
    add(height(pose, Bone::head) + 0.15);
    add(R"(,"hipHeight":)");
    add(height(pose, Bone::hips));
    add(R"(},"body":{)");
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const auto bone = static_cast<std::size_t>(joints_[i].bone);
      if (i > 0) add(",");
      add("\"");
      add(joints_[i].name);
      const Eigen::Vector3d place =
          pose.placed[bone] ? mirrored(pose.places[bone]) : Eigen::Vector3d(0, 0, 0);
      // The upper chest, which it lacks, is what carries neck and arms.
      constexpr std::size_t chest = index_of(Bone::chest), upper = index_of(Bone::upper_chest);
      const std::size_t turned = bone == chest && pose.turned[upper] ? upper : bone;
      const Eigen::Quaterniond q = mirrored(pose.turns[turned]) * rokoko_t_pose(joints_[i].bone);
      add(R"(":{"position":{"x":)", place.x());
      add(R"(,"y":)", place.y());
      add(R"(,"z":)", place.z());
      add(R"(},"rotation":{"x":)", q.x());
      add(R"(,"y":)", q.y());
      add(R"(,"z":)", q.z());
      add(R"(,"w":)", q.w());
      add("}}");
    }
    add("}}],\"props\":[]}}");
  }
  std::span<const Datagram> packets() const noexcept override { return {&datagram_, 1}; }

 private:
  struct Joint {
    int bone;
    std::string name;
  };
  static double height(const HumanoidPose& pose, Bone bone) noexcept {
    return pose.placed[index_of(bone)] ? pose.places[index_of(bone)].y() : 1;
  }
  void add(std::string_view text) noexcept {
    const std::size_t at = datagram_.data.size();
    datagram_.data.resize(at + text.size());
    std::memcpy(datagram_.data.data() + at, text.data(), text.size());
  }
  void add(double number) noexcept {
    char text[32];
    const auto [end, failure] =
        std::to_chars(text, text + sizeof text, number, std::chars_format::general, 9);
    add(std::string_view(text, static_cast<std::size_t>(end - text)));
  }
  void add(std::string_view text, double number) noexcept { add(text), add(number); }

  std::vector<Joint> joints_;
  bool fingers_ = false;
  Datagram datagram_;
};

}  // namespace

std::unique_ptr<FormPacker> rokoko_packer(const std::vector<int>& bones) {
  return std::make_unique<RokokoPacker>(bones);
}

}  // namespace gait::osc
