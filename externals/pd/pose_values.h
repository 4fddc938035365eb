// A whole body's rotations as the `pose` message has them: three values per joint of the body.
#pragma once

#include <span>
#include <vector>

#include "gait/model/body_pose.h"

namespace gait::pd {

class PoseValues {
 public:
  explicit PoseValues(const Body& body)
      : references_(float_references(body)), values_(3 * references_.size()) {}

  // `pose`: local rotations, one per joint of the body. Valid until the next call.
  std::span<const float> of(std::span<const Eigen::Quaternionf> pose) noexcept {
    pose_vector<float>(pose, references_, values_);
    return values_;
  }

 private:
  std::vector<Eigen::Quaternionf> references_;
  std::vector<float> values_;
};

}  // namespace gait::pd
