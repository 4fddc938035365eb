// A walk as it comes, cycle by cycle as points in a space of cycles (T10 eq. 1): frames between two
// right contacts are brought to the space's number of frames and projected.
//
// Time is taken to pass evenly between contacts, as in training (learn/cycles). Of a long cycle
// every second, fourth ... frame is kept, at least 64. Nothing allocates after construction.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "gait/model/cycle_space.h"
#include "gait/model/model.h"
#include "gait/motion/steps.h"

namespace gait {

class CycleProjector {
 public:
  static constexpr int most_frames = 1024;  // of a cycle; longer ones are not projected

  // `space`: one of the model's, which has a body.
  CycleProjector(std::shared_ptr<const Model> model, const CycleSpace& space);

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
  static constexpr int most_kept = 128;  // frames

  void keep() noexcept;
  void frame_at(double frames) noexcept;
  void project() noexcept;

  std::shared_ptr<const Model> model_;
  const CycleSpace& space_;
  Eigen::VectorXf inverse_deviation_;  // per component
  Eigen::VectorXf newest_;             // the frame taken last, 3 * joints
  Eigen::MatrixXf kept_;               // columns: frames 0, stride, 2 stride ...
  int stride_ = 1;
  int count_ = 0, left_ = 0;  // frames taken since the right contact; where the left foot touched,
                              // 0: did not
  bool whole_ = false;        // began with a right contact, and fits
  Eigen::VectorXf scores_;
  Eigen::VectorXd frame_, sums_;
};

}  // namespace gait
