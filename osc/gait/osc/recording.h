// Recording: frames of one performer as they came, made a clip of the sender's own rig.
#pragma once

#include <vector>

#include "gait/motion/clip.h"
#include "gait/osc/sender_pose.h"

namespace gait::osc {

class Recording {
 public:
  static constexpr int most_frames = 1 << 20;  // nearly five hours at 60 a second

  // False when it is full, or the frame says nothing of a body (values of a model).
  bool add(const CapturedFrame& frame);
  int frames() const { return static_cast<int>(times_.size()); }
  // Frames per second as they came, a whole number where it is within a hundredth of one; 30 for a
  // single frame.
  double frame_rate() const;

  // All frames, one after the other. Bones whose places nobody told have usual lengths. Throws
  // Error when there are none.
  Clip clip(const std::string& name) const;

 private:
  struct Joint {  // of one frame
    Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
    Eigen::Vector3f place = Eigen::Vector3f::Zero();
    bool placed = false;
  };
  void add_humanoid();
  void add_named(const CapturedFrame& frame);
  Skeleton humanoid_skeleton(std::vector<int>& bones) const;

  bool by_names_ = false;
  SenderPose pose_;
  std::bitset<humanoid_bones> told_;
  std::array<Eigen::Vector3d, humanoid_bones> offsets_;
  std::bitset<humanoid_bones> offset_known_;
  std::vector<NamedJoint> rig_;  // as it was told last
  std::vector<double> times_;
  std::vector<std::vector<Joint>> poses_;  // by bone, or by named joint
};

}  // namespace gait::osc
