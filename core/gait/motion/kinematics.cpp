#include "gait/motion/kinematics.h"

namespace gait {

void forward_kinematics(const Skeleton& skeleton, std::span<const Eigen::Quaterniond> rotations,
                        std::span<const Eigen::Vector3d> translations,
                        std::span<Eigen::Quaterniond> global_rotations,
                        std::span<Eigen::Vector3d> positions) noexcept {
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    const int parent = skeleton.joints[joint].parent;
    Placement<double> placed{rotations[joint], translations[joint]};
    if (parent >= 0)
      placed = placed_under<double>({global_rotations[parent], positions[parent]}, placed.rotation,
                                    placed.place);
    global_rotations[joint] = placed.rotation;
    positions[joint] = placed.place;
  }
}

WorldPoses world_poses(const Clip& clip) {
  WorldPoses world;
  world.rotations.resize(clip.rotations.size());
  world.positions.resize(clip.rotations.size());
  const std::size_t joints = clip.skeleton.joints.size();
  for (int frame = 0; frame < clip.frames(); ++frame)
    forward_kinematics(clip.skeleton, clip.pose(frame), clip.translation(frame),
                       {world.rotations.data() + frame * joints, joints},
                       {world.positions.data() + frame * joints, joints});
  return world;
}

}  // namespace gait
