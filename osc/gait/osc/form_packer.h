// Form packer: packs humanoids in the form of another program. Nothing allocates after
// construction.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gait/motion/humanoid.h"

namespace gait::osc {

struct Datagram {
  std::vector<std::byte> data;
  std::span<const std::byte> bytes() const noexcept { return data; }
  std::size_t size() const noexcept { return data.size(); }
};

class FormPacker {
 public:
  virtual ~FormPacker() = default;
  // Packs a frame: turns since the T-pose, and places of the hips (and of the rest, where known).
  // `time` in seconds, for the receiver's clock; `frame` counts from 0.
  virtual void pack(const HumanoidPose& pose, double time, int frame) noexcept = 0;
  // The datagrams of the frame packed last.
  virtual std::span<const Datagram> packets() const noexcept = 0;
};

}  // namespace gait::osc
