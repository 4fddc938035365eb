// Inertialisation of whole frames (hand_over.h), from one motion to another: rotations turn from
// the one to the other, plain values go linearly.
//
// Frames are values in the streams' order, rotations as rotation vectors (radians). Once it is
// over, frames are the new motion's, untouched. Nothing allocates after construction.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gait/model/stream_layout.h"
#include "gait/play/change/hand_over.h"

namespace gait {

class StreamHandOver {
 public:
  using Values = Eigen::Ref<const Eigen::VectorXf>;

  StreamHandOver(const StreamLayout& layout, double frame_rate);

  // `shown`, `motion`: the last frame of what was shown and of what goes on; `..._before`: the ones
  // before.
  void begin(const Values& shown, const Values& shown_before, const Values& motion,
             const Values& motion_before) noexcept;
  // Only one frame of the new motion is there: as if both had moved alike so far.
  void begin(const Values& shown, const Values& motion) noexcept;
  // The new motion begins with `first`, one frame after `shown`, and nothing is known of before: as
  // if it went on just as what was shown did.
  void begin_before(const Values& shown, const Values& shown_before, const Values& first) noexcept;

  // Moves on by one frame and changes the new motion's `values` into what is to be shown.
  void apply(Eigen::Ref<Eigen::VectorXf> values) noexcept;
  bool over() const noexcept { return hand_over_.over(); }
  void stop() noexcept { hand_over_.stop(); }

 private:
  void difference(const Values& shown, const Values& motion, Eigen::VectorXf& offset) noexcept;
  void add(Eigen::Ref<Eigen::VectorXf> values, const Eigen::VectorXf& offset) noexcept;

  std::vector<Eigen::Index> rotations_;  // where the three values of each begin
  std::vector<Eigen::Index> plain_;
  HandOver hand_over_;
  Eigen::VectorXf offset_, offset_before_;
};

}  // namespace gait
