// Humanoid sender: packs a humanoid's frames in the form of another program. Nothing allocates
// after construction.
#pragma once

#include <memory>
#include <vector>

#include "gait/motion/humanoid.h"
#include "gait/osc/form_packer.h"
#include "gait/osc/mocap_event.h"

namespace gait::osc {

class HumanoidSender {
 public:
  // `bones`: indices of the bones to send, parents first. Throws Error for a form that is only
  // received.
  HumanoidSender(MocapForm form, const std::vector<int>& bones);

  // As FormPacker::pack. Send packets() then.
  void pack(const HumanoidPose& pose, double time, int frame) noexcept {
    packer_->pack(pose, time, frame);
  }
  std::span<const Datagram> packets() const noexcept { return packer_->packets(); }

 private:
  std::unique_ptr<FormPacker> packer_;
};

}  // namespace gait::osc
