// Trajectory generator (T14 §4.3, MAGE; Tokuda et al. 2000): the smoothest path through a queue of
// Gaussians over statics, first and second differences.
//
// The queue holds past P, current C and future F frames. Per output value the maximum-likelihood
// statics c solve W^T V^-1 W c = W^T V^-1 mu, a symmetric system of bandwidth 2 over the frames of
// the queue, by banded L D L^T. As in HTS, differences count only where their whole window lies
// inside the queue. Only the current frames leave.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "gait/play/output_gaussian.h"

namespace gait {

// Frames of a queue that is so many seconds long.
inline int queue_frames(double seconds, double frame_rate) {
  return std::max(0, static_cast<int>(std::lround(seconds * frame_rate)));
}

class Trajectory {
 public:
  // `values`: modelled output values; the rest are frames, C at least 1.
  Trajectory(int values, int past, int current, int future);

  // Takes the next frame's Gaussian (3 * values entries each) into the queue.
  void push(const OutputGaussian& gaussian) noexcept;

  // Whether `current` frames can leave: the queue holds current + future frames or more, and
  // `current` were pushed since the last time.
  bool ready() const noexcept;

  // Solves the queue and gives its current frames, values by C, oldest first. Valid until the next
  // call.
  Eigen::Ref<const Eigen::MatrixXf> generate() noexcept;

  // For the end of a stream: the queue's last `count` frames, values by count; what was still in
  // the future.
  Eigen::Ref<const Eigen::MatrixXf> flush(int count) noexcept;

  int delay() const noexcept { return future_ + current_ - 1; }  // frames
  int filled() const noexcept { return filled_; }                // frames in the queue
  int past() const noexcept { return past_; }
  int future() const noexcept { return future_; }
  void reset() noexcept { filled_ = fresh_ = 0; }
  // A longer or shorter queue, in which the newest frames stay. This one allocates.
  void resize(int past, int future);

 private:
  void solve() noexcept;
  void substitute(int first) noexcept;
  // Column of the queue's frame `i`, 0 the oldest.
  int column(int i) const noexcept { return (newest_ + 1 + i - filled_ + 2 * length_) % length_; }

  int values_, past_, current_, future_, length_;
  int newest_ = 0, filled_ = 0, fresh_ = 0;
  // Ring of frames, values by length: weighted means and weights (inverse variances) of each part.
  Eigen::ArrayXXf weight_[3], target_[3];
  // The banded system, values by length: diagonal, first and second off-diagonal, right-hand side.
  Eigen::ArrayXXf diagonal_, off_, far_, right_;
  Eigen::MatrixXf path_;
};

}  // namespace gait
