// Packs the VMC protocol: see vmc_reader.cpp.
#include "gait/osc/osc_packer.h"
#include "gait/osc/packers.h"

namespace gait::osc {

namespace {

class VmcPacker final : public OscPacker {
 public:
  explicit VmcPacker(const std::vector<int>& bones) : bones_(bones) {
    add_message("/VMC/Ext/Root/Pos", "sfffffff", {"root"});
    for (const int bone : bones_)
      add_message("/VMC/Ext/Bone/Pos", "sfffffff", {std::string(bone_name(bone))});
    add_message("/VMC/Ext/OK", "i");
    add_message("/VMC/Ext/T", "f");
    laid_out();
  }
  void pack(const HumanoidPose& pose, double time, int) noexcept override {
    begin();
    add(Eigen::Vector3d(0, 0, 0));
    add(Eigen::Quaterniond::Identity());
    for (const int bone : bones_) {
      // Zeros where a place is not known.
      add(mirrored(pose.locally_placed(bone) ? pose.local_place(bone) : Eigen::Vector3d(0, 0, 0)));
      add(mirrored(pose.local_turn(bone)));
    }
    add(1);
    add(time);
    end();
  }

 private:
  std::vector<int> bones_;
};

}  // namespace

std::unique_ptr<FormPacker> vmc_packer(const std::vector<int>& bones) {
  return std::make_unique<VmcPacker>(bones);
}

}  // namespace gait::osc
