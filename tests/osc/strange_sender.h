// A sender of the VMC protocol with a rig of its own, and the walks that it streams.
#pragma once

#include <array>
#include <random>
#include <string>
#include <vector>

#include "gait/motion/humanoid.h"
#include "gait/motion/humanoid_body.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/rotation.h"
#include "gait/osc/packet_template.h"

namespace gait::testing {

// Every joint's frame is turned against the body's by some rotation that nobody is told, the whole
// stage by a yaw, and X is mirrored, as in Unity. Names are Unity's.
class StrangeSender {
 public:
  explicit StrangeSender(unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (Eigen::Quaterniond& turn : rest_)
      turn = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                 .normalized();
    stage_ = about_vertical(normal(random) * 2);
  }
  // Packets of a body that has so turned since the T-pose.
  osc::PacketSequence packets(const HumanoidPose& pose) const {
    osc::PacketSequence packets;
    std::vector<float> numbers;
    std::array<Eigen::Quaterniond, humanoid_bones> world;
    for (int bone = 0; bone < humanoid_bones; ++bone) {
      if (!pose.turned[bone]) continue;
      world[bone] = stage_ * pose.turns[bone] * rest_[bone];
      const int above = pose.turned_above(bone);
      const Eigen::Quaterniond local =
          above < 0 ? world[bone] : world[above].conjugate() * world[bone];
      packets.add("/VMC/Ext/Bone/Pos", "sfffffff", {std::string(bone_name(bone))});
      const Eigen::Vector3d place = mirrored(Eigen::Vector3d(
          above < 0 ? Eigen::Vector3d(stage_ * pose.places[bone] + Eigen::Vector3d(1, 0, 2))
                    : Eigen::Vector3d(world[above].conjugate() *
                                      (stage_ * (pose.places[bone] - pose.places[above])))));
      const Eigen::Quaterniond unity = mirrored(local);
      for (const double number :
           {place.x(), place.y(), place.z(), unity.x(), unity.y(), unity.z(), unity.w()})
        numbers.push_back(static_cast<float>(number));
    }
    packets.add("/VMC/Ext/OK", "i");
    numbers.push_back(1);
    packets.set(numbers);
    return packets;
  }

 private:
  std::array<Eigen::Quaterniond, humanoid_bones> rest_;
  Eigen::Quaterniond stage_;
};

// A walk, frame by frame, as turns since the T-pose.
inline std::vector<HumanoidPose> humanoid_poses(const Clip& clip, const HumanoidBody& body) {
  const WorldPoses world = world_poses(clip);
  const auto joints = static_cast<std::size_t>(clip.skeleton.size());
  std::vector<HumanoidPose> poses;
  for (int frame = 0; frame < clip.frames(); ++frame) {
    const std::size_t at = joints * static_cast<std::size_t>(frame);
    body.read({world.rotations.data() + at, joints}, {world.positions.data() + at, joints},
              poses.emplace_back());
  }
  return poses;
}

// Who stands for the calibration, of any build.
inline HumanoidPose standing_pose(const HumanoidBody& body, CalibrationPose stand) {
  HumanoidPose standing = body.calibration(stand);
  for (int bone = 0; bone < humanoid_bones; ++bone) {
    standing.placed.set(bone);
    standing.places[bone] = usual_offset(bone);
    if (bone_parent(bone) >= 0) standing.places[bone] += standing.places[bone_parent(bone)];
  }
  return standing;
}

}  // namespace gait::testing
