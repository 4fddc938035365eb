#include "gait/motion/sender_calibration.h"

#include <cmath>

#include "gait/motion/heading.h"
#include "gait/motion/rotation.h"

namespace gait {

double facing_of(const HumanoidPose& pose) noexcept {
  constexpr Bone pairs[][2] = {{Bone::left_upper_leg, Bone::right_upper_leg},
                               {Bone::left_upper_arm, Bone::right_upper_arm}};
  for (const auto& [left, right] : pairs) {
    if (!pose.placed[index_of(left)] || !pose.placed[index_of(right)]) continue;
    const Eigen::Vector3d across = pose.places[index_of(left)] - pose.places[index_of(right)];
    if (std::hypot(across.x(), across.z()) > 0.01) return heading_across(across);
  }
  const Eigen::Quaterniond twist =
      swing_twist<double>(pose.turns[index_of(Bone::hips)], Eigen::Vector3d::UnitY()).twist;
  return 2 * std::atan2(twist.y(), twist.w());
}

bool SenderCalibration::set(const HumanoidPose& sender, const HumanoidPose& standing) noexcept {
  if (!sender.turned[index_of(Bone::hips)]) return false;
  set_ = true;
  seen_ = sender.turned;
  facing_ = about_vertical(facing_of(sender));
  Eigen::Quaterniond stand = Eigen::Quaterniond::Identity();
  for (std::size_t bone = 0; bone < humanoid_bones; ++bone) {
    before_[bone] = sender.turns[bone].conjugate();
    // Fingers stand as their hand does; bones the body lacks, as those above them.
    const int parent = bone_parent(static_cast<int>(bone));
    stand = standing.turned[bone] ? standing.turns[bone]
            : parent >= 0         ? stand_[static_cast<std::size_t>(parent)]
                                  : Eigen::Quaterniond::Identity();
    stand_[bone] = stand;
  }
  return true;
}

void SenderCalibration::apply(HumanoidPose& pose, double yaw) const noexcept {
  const Eigen::Quaterniond facing = set_ ? facing_ * about_vertical(yaw) : about_vertical(-yaw);
  const Eigen::Quaterniond back = facing.conjugate();
  for (std::size_t bone = 0; bone < humanoid_bones; ++bone) {
    if (set_ && !seen_[bone]) pose.turned.reset(bone);
    if (pose.turned[bone])
      pose.turns[bone] = set_ ? back * (pose.turns[bone] * before_[bone]) * facing * stand_[bone]
                              : back * pose.turns[bone];
    if (pose.placed[bone]) pose.places[bone] = back * pose.places[bone];
  }
}

}  // namespace gait
