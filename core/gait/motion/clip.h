// Clip: a skeleton and its frames at a frame rate.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "gait/motion/skeleton.h"

namespace gait {

struct Clip {
  std::string name;  // the path of the file it was read from, or the name of its maker
  Skeleton skeleton;
  double frame_rate = 30;  // frames per second

  // Frame after frame, one entry per joint: the joint's local rotation, and its translation from
  // its parent in the parent's frame (the offset, or what position channels put in its place).
  std::vector<Eigen::Quaterniond> rotations;
  std::vector<Eigen::Vector3d> translations;

  int frames() const {
    return skeleton.joints.empty() ? 0
                                   : static_cast<int>(rotations.size() / skeleton.joints.size());
  }
  // One frame's rotations or translations, one per joint.
  std::span<const Eigen::Quaterniond> pose(int frame) const { return row(rotations, frame); }
  std::span<Eigen::Quaterniond> pose(int frame) { return row(rotations, frame); }
  std::span<const Eigen::Vector3d> translation(int frame) const { return row(translations, frame); }
  std::span<Eigen::Vector3d> translation(int frame) { return row(translations, frame); }

  // Makes room for `count` frames: identity rotations, every joint at its offset.
  void resize(int count) {
    rotations.assign(static_cast<std::size_t>(count) * skeleton.joints.size(),
                     Eigen::Quaterniond::Identity());
    translations.resize(rotations.size());
    for (int frame = 0; frame < count; ++frame)
      for (int joint = 0; joint < skeleton.size(); ++joint)
        translation(frame)[joint] = skeleton.joints[joint].offset;
  }

 private:
  template <typename Values>
  auto row(Values& values, int frame) const
      -> std::span<std::remove_pointer_t<decltype(values.data())>> {
    const std::size_t joints = skeleton.joints.size();
    return {values.data() + static_cast<std::size_t>(frame) * joints, joints};
  }
};

}  // namespace gait
