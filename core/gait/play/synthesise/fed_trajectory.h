// The smooth path through the Gaussians that a synthesiser is fed: Trajectory over the values that
// the model moves, and beside it the means of the other values, delayed alike.
//
// The queue is solved every `current` frames, and one frame leaves with each that is taken: a frame
// leaves `future + current - 1` frames after it was taken. Values are the model's output values, in
// the streams' own units. Nothing allocates after construction, but for resize.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "gait/model/model.h"
#include "gait/play/synthesise/trajectory.h"

namespace gait {

class FedTrajectory {
 public:
  // Frames of the queue: past whole_past, or 0 or more; current 1 or more, future 0 or more.
  FedTrajectory(const Model& model, int past, int current, int future);

  // Takes the next frame's Gaussian over all output values: statics, first, then second differences
  // per frame. The variances of differences are eased (PlayDefaults::easing). True when a frame
  // leaves with it.
  bool push(std::span<const float> means, std::span<const float> variances) noexcept;
  // Releases the oldest frame held back, without a new one. False when none is held back.
  bool flush() noexcept;

  // The output values of the frame that left last.
  const Eigen::VectorXf& values() const noexcept { return values_; }
  // How many of the frames taken have not left yet.
  int held() const noexcept { return held_; }
  // Whether flush() released a frame since construction, reset() or forget_flushed().
  bool flushed() const noexcept { return flushed_; }

  int past() const noexcept { return trajectory_.past(); }
  int future() const noexcept { return trajectory_.future(); }
  int delay() const noexcept { return trajectory_.delay(); }
  // Begins anew: frames that are held back do not leave.
  void reset() noexcept;
  // A longer or shorter queue, in which the newest frames stay.
  void resize(int past, int future);
  // Makes flushed() false: after resize(), what was released no longer says that the input ended.
  void forget_flushed() noexcept { flushed_ = false; }

 private:
  void leave(const Eigen::Ref<const Eigen::VectorXf>& modelled) noexcept;

  std::vector<int> modelled_;
  float easing_;
  Trajectory trajectory_;
  OutputGaussian gaussian_;
  Eigen::MatrixXf told_;  // means of all output values: a ring of columns, one per frame held
  int newest_ = 0;
  Eigen::MatrixXf path_;  // the frames that were solved last, modelled values by `current`
  int solved_ = 0;        // of those, how many have not left yet
  int held_ = 0;
  bool flushed_ = false;
  Eigen::VectorXf values_;
};

}  // namespace gait
