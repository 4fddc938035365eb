// Humanoid sender: packs a humanoid's frames in the forms of other programs: VMC, NatNet or
// NeuronOSC. Nothing allocates after construction.
#pragma once

#include <vector>

#include "gait/motion/humanoid.h"
#include "gait/osc/mocap_event.h"
#include "gait/osc/packet_template.h"

namespace gait::osc {

class HumanoidSender {
 public:
  // `bones`: indices of the bones to send, parents first. Throws Error for other forms.
  HumanoidSender(MocapForm form, const std::vector<int>& bones);

  // Packs a frame: turns since the T-pose, and places of the hips (and of the rest, where known).
  // `time` in seconds, for the receiver's clock. Send packets() then.
  void pack(const HumanoidPose& pose, double time, int frame) noexcept;
  std::span<const PacketTemplate> packets() const noexcept { return packets_.packets(); }

 private:
  MocapForm form_;
  std::vector<int> bones_, joints_;  // joints_: by NeuronOSC's numbers, for that form
  PacketSequence packets_;
  std::vector<float> numbers_;
};

}  // namespace gait::osc
