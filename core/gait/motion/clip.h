// Clip: a skeleton and its frames at a frame rate.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "gait/motion/skeleton.h"

namespace gait {

struct Clip {
  std::string name;  // where it comes from: the file's path, or what made it
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
  std::span<const Eigen::Quaterniond> pose(int frame) const {
    return {rotations.data() + static_cast<std::size_t>(frame) * skeleton.joints.size(),
            skeleton.joints.size()};
  }
  std::span<Eigen::Quaterniond> pose(int frame) {
    return {rotations.data() + static_cast<std::size_t>(frame) * skeleton.joints.size(),
            skeleton.joints.size()};
  }
  std::span<const Eigen::Vector3d> translation(int frame) const {
    return {translations.data() + static_cast<std::size_t>(frame) * skeleton.joints.size(),
            skeleton.joints.size()};
  }
  std::span<Eigen::Vector3d> translation(int frame) {
    return {translations.data() + static_cast<std::size_t>(frame) * skeleton.joints.size(),
            skeleton.joints.size()};
  }

  // Makes room for `count` frames: identity rotations, every joint at its offset.
  void resize(int count) {
    rotations.assign(static_cast<std::size_t>(count) * skeleton.joints.size(),
                     Eigen::Quaterniond::Identity());
    translations.resize(rotations.size());
    for (int frame = 0; frame < count; ++frame)
      for (int joint = 0; joint < skeleton.size(); ++joint)
        translation(frame)[joint] = skeleton.joints[joint].offset;
  }
};

}  // namespace gait
