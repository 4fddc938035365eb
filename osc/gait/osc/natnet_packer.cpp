// Packs what NatNetThree2OSC sends in its mode max, with the bones' names in every frame: see
// natnet_reader.cpp.
#include "gait/osc/osc_packer.h"
#include "gait/osc/packers.h"

namespace gait::osc {

namespace {

// Motive's own naming of a body; for bones that it lacks, Unity's.
std::string motive_name(int bone) {
  constexpr std::array<std::string_view, main_bones> names{
      "Hip",   "Ab",    "Chest",     "UpperChest", "Neck",  "Head",  "LShoulder", "LUArm",
      "LFArm", "LHand", "RShoulder", "RUArm",      "RFArm", "RHand", "LThigh",    "LShin",
      "LFoot", "LToe",  "RThigh",    "RShin",      "RFoot", "RToe"};
  if (bone < main_bones) return std::string(names[static_cast<std::size_t>(bone)]);
  if (bone < index_of(Bone::left_fingers)) return std::string(bone_name(bone));
  constexpr std::array<std::string_view, 5> fingers{"Thumb", "Index", "Middle", "Ring", "Pinky"};
  const int finger = bone - index_of(Bone::left_fingers);
  return std::string(finger < 15 ? "L" : "R") +
         std::string(fingers[static_cast<std::size_t>(finger % 15 / 3)]) +
         std::to_string(finger % 3 + 1);
}

class NatnetPacker final : public OscPacker {
 public:
  explicit NatnetPacker(const std::vector<int>& bones) : bones_(bones) {
    add_message("/frame/start", "i");
    add_message("/frame/timestamp", "f");
    for (const int bone : bones_)
      add_message("/motive/skeleton/id/bone", "sis", {"gait", "gait_" + motive_name(bone)});
    for (std::size_t i = 0; i < bones_.size(); ++i) {
      add_message("/skeleton/bone", "sisfff", {"gait", "position"});
      add_message("/skeleton/bone", "sisffff", {"gait", "quat"});
    }
    add_message("/frame/end", "i");
    laid_out();
  }
  void pack(const HumanoidPose& pose, double time, int frame) noexcept override {
    begin();
    add(frame);
    add(1000 * time);
    for (const int bone : bones_) add(bone + 1);
    for (const int bone : bones_) {
      add(bone + 1);
      add(pose.locally_placed(bone) ? pose.local_place(bone) : Eigen::Vector3d(0, 0, 0));
      add(bone + 1);
      add(pose.local_turn(bone));
    }
    add(frame);
    end();
  }

 private:
  std::vector<int> bones_;
};

}  // namespace

std::unique_ptr<FormPacker> natnet_packer(const std::vector<int>& bones) {
  return std::make_unique<NatnetPacker>(bones);
}

}  // namespace gait::osc
