// How fast joints turn and how fast that changes, and the percentiles that joins are judged by.
#pragma once

#include <algorithm>
#include <vector>

#include "gait/learn/sequence.h"
#include "gait/model/model.h"
#include "gait/motion/rotation.h"

namespace gait::testing {

using Pose = std::vector<Eigen::Quaterniond>;

struct JointMotion {
  std::vector<double> speeds, accelerations;  // rad/s, rad/s²; one per joint and frame

  // Over the frames from `begin` to before `end`; the first needs two before it.
  void add(const std::vector<Pose>& poses, double frame_rate, std::size_t begin, std::size_t end) {
    for (std::size_t frame = std::max<std::size_t>(2, begin); frame < std::min(end, poses.size());
         ++frame)
      for (std::size_t joint = 0; joint < poses[frame].size(); ++joint) {
        const auto turned = [&](std::size_t at) {
          return Eigen::Vector3d(
              frame_rate *
              rotation_vector<double>(poses[at - 1][joint].conjugate() * poses[at][joint]));
        };
        speeds.push_back(turned(frame).norm());
        accelerations.push_back(frame_rate * (turned(frame) - turned(frame - 1)).norm());
      }
  }
};

inline double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// Poses of a sequence's streams as it was learnt from, between its first and last contact.
inline std::vector<Pose> poses_of(const Sequence& sequence) {
  std::vector<Pose> poses;
  for (int frame = sequence.segments.front().begin; frame < sequence.segments.back().end; ++frame) {
    poses.emplace_back();
    for (const Eigen::MatrixXd* values : {&sequence.inputs, &sequence.outputs})
      for (Eigen::Index at = 0; at < values->rows(); at += 3)
        poses.back().push_back(
            exponential_map<double>(Eigen::Vector3d(values->col(frame).segment<3>(at))));
  }
  return poses;
}

}  // namespace gait::testing
