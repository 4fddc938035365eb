// Rig sender: sends a rig with its own names in the project's own form, so that the receiver has
// the same rig. Nothing allocates after construction.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "gait/motion/skeleton.h"
#include "gait/osc/packet_template.h"

namespace gait::osc {

class RigSender {
 public:
  // Skeleton in metres. Throws Error when it has more joints than a receiver takes or a name is too
  // long.
  explicit RigSender(const Skeleton& skeleton);

  // The rig itself: before the first frame and every second or so.
  std::span<const PacketTemplate> rig() const noexcept { return rig_.packets(); }
  // One frame: local rotation and place relative to its parent, of every joint.
  void pack(std::span<const Eigen::Quaterniond> rotations,
            std::span<const Eigen::Vector3d> translations, int frame) noexcept;
  std::span<const PacketTemplate> packets() const noexcept { return packets_.packets(); }

 private:
  PacketSequence rig_, packets_;
  std::vector<float> numbers_;
};

// A model's pose (`pose` and `root` messages) in the project's own form.
class PoseSender {
 public:
  explicit PoseSender(int values);
  // `root`: x y z heading.
  void pack(std::span<const float> root, std::span<const float> pose) noexcept;
  std::span<const PacketTemplate> packets() const noexcept { return packets_.packets(); }

 private:
  PacketSequence packets_;
  std::vector<float> numbers_;
};

}  // namespace gait::osc
