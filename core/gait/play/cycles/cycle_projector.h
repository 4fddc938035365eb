// A walk as it comes, cycle by cycle as points in a space of cycles (T10 eq. 1): frames between two
// right contacts are brought to the space's number of frames and projected.
//
// Time is taken to pass evenly between contacts, as in training (learn/cycles). Nothing allocates
// after construction.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "gait/model/cycle_space.h"
#include "gait/model/model.h"
#include "gait/motion/steps.h"

namespace gait {

class CycleProjector {
 public:
  static constexpr int most_frames = 1024;  // of a cycle; longer ones are not projected

  // Keeps what it needs of the space and the body.
  CycleProjector(const CycleSpace& space, const Body& body);

  // The next frame: rotation vectors relative to the body's references, three per joint of the body
  // (radians), the hips' with heading out. False, with nothing changed, for another size.
  bool add(std::span<const float> pose) noexcept;

  // A foot touched at the frame added last: it belongs to the new step. True when a cycle from
  // right to right contact is whole; then `scores` speaks of it.
  bool contact(Foot foot) noexcept;

  // One per component, in deviations of that component over all the space's cycles.
  std::span<const float> scores() const noexcept {
    return {scores_.data(), static_cast<std::size_t>(scores_.size())};
  }
  void reset() noexcept;

 private:
  void project() noexcept;

  int frames_ = 0, pose_values_ = 0;
  std::vector<int> joints_;  // of the body
  Eigen::VectorXf mean_;
  Eigen::MatrixXf components_;         // values by components
  Eigen::VectorXf inverse_deviation_;  // per component
  Eigen::MatrixXf taken_;              // 3 * joints by most_frames: since the right contact
  int count_ = 0, left_ = 0;           // frames taken; where the left foot touched, 0: did not
  bool whole_ = false;                 // began with a right contact, and fits
  Eigen::VectorXf cycle_, scores_;
};

}  // namespace gait
