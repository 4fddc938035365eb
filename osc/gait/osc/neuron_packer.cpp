// Packs NeuronOSC: see neuron_reader.cpp. Places and rotations are in the world.
#include "gait/osc/neuron_joints.h"
#include "gait/osc/osc_packer.h"
#include "gait/osc/packers.h"

namespace gait::osc {

namespace {

class NeuronPacker final : public OscPacker {
 public:
  explicit NeuronPacker(const std::vector<int>& bones) {
    for (const int bone : bones)
      if (const int joint = neuron_joint(bone); joint >= 0) {
        bones_.push_back(bone);
        joints_.push_back(joint);
        add_message("/perception_joint", "ifffffff");
      }
    laid_out();
  }
  void pack(const HumanoidPose& pose, double, int) noexcept override {
    begin();
    for (std::size_t i = 0; i < bones_.size(); ++i) {
      const auto bone = static_cast<std::size_t>(bones_[i]);
      add(joints_[i]);
      add(pose.placed[bone] ? pose.places[bone] : Eigen::Vector3d(0, 0, 0));
      add(pose.turns[bone]);
    }
    end();
  }

 private:
  std::vector<int> bones_, joints_;
};

}  // namespace

std::unique_ptr<FormPacker> neuron_packer(const std::vector<int>& bones) {
  return std::make_unique<NeuronPacker>(bones);
}

}  // namespace gait::osc
