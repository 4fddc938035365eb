// What a walker walks, written into a clip: its poses are put back into the world, on ground that
// its own feet find (RootMotion) and keep (FootLock), along a path that may turn.
//
// Units: metres, seconds, radians.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gait/model/body_pose.h"
#include "gait/motion/clip.h"
#include "gait/play/body/foot_lock.h"
#include "gait/play/body/root_motion.h"

namespace gait {

// A walk is played for so long before it is recorded: the feet find their direction.
inline constexpr double lead_in_seconds = 2;

class WalkRecorder {
 public:
  // `scale`: how much larger than the model's body the walker is. `turn`: heading rate, radians per
  // second, above 0 to the left. Throws Error when the body has no legs.
  WalkRecorder(const Body& body, double frame_rate, double scale = 1, double turn = 0);

  // A frame before the clip begins: the feet find their way, nothing is kept.
  void lead_in(std::span<const Eigen::Quaternionf> pose) { stand(pose, 0); }
  // `pose`: local rotations of the model's body, the hips' with heading out.
  void add(std::span<const Eigen::Quaternionf> pose);

  int frames() const { return static_cast<int>(hips_.size()); }
  // All frames added, from above the origin and along +Z.
  Clip clip(const std::string& name) const;

 private:
  Eigen::Vector3d stand(std::span<const Eigen::Quaternionf> pose, double heading);

  Body body_;
  JointRoles roles_;
  double frame_rate_, turn_;
  RootMotion root_;
  FootLock lock_;
  std::vector<Eigen::Quaternionf> standing_;  // the pose on the ground
  Eigen::Vector3d start_ = Eigen::Vector3d::Zero();
  std::vector<Eigen::Quaterniond> rotations_;  // frame after frame
  std::vector<Eigen::Vector3d> hips_;
};

}  // namespace gait
