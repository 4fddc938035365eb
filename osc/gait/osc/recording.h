// Recording: stores the frames of one performer and makes a clip on the sender's own rig from them.
#pragma once

#include <vector>

#include "gait/motion/clip.h"
#include "gait/osc/sender_pose.h"

namespace gait::osc {

class Recording {
 public:
  static constexpr int most_frames = 1 << 20;  // nearly five hours at 60 a second

  // Returns false when it is full, or when the frame holds no body (values of a model).
  bool add(const CapturedFrame& frame);
  int frames() const { return static_cast<int>(times_.size()); }
  // Frames per second of the arrivals, a whole number when it is within a hundredth of one; 30 for
  // a single frame.
  double frame_rate() const;

  // All frames as a clip. Bones without known places have usual lengths. Throws Error when there
  // are no frames.
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
  std::vector<NamedJoint> rig_;  // as it last arrived
  std::vector<double> times_;
  std::vector<std::vector<Joint>> poses_;  // by bone, or by named joint
};

}  // namespace gait::osc
