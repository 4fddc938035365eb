// Trajectory generator (T14 §4.3, MAGE; Tokuda et al. 2000): the smoothest path through a queue of
// Gaussians over statics, first and second differences.
//
// The queue holds past P, current C and future F frames. Per output value the maximum-likelihood
// statics c solve W^T V^-1 W c = W^T V^-1 mu, a symmetric system of bandwidth 2 over the frames of
// the queue, by banded L D L^T. As in HTS, differences count only where their whole window lies
// inside the queue. Only the current frames leave.
//
// A frame that comes changes only the last three rows of the system. With the whole past (every
// frame since the last reset) the factorisation is therefore carried on from frame to frame: what
// it costs does not depend on how long that past is. With a past of P frames the oldest frame
// leaves the queue with each new one, which changes all columns: the queue is factored anew.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "gait/play/output_gaussian.h"

namespace gait {

// P of a queue from which no past frame leaves.
constexpr int whole_past = -1;

// Frames of a queue that is so many seconds long.
inline int queue_frames(double seconds, double frame_rate) {
  return std::max(0, static_cast<int>(std::lround(seconds * frame_rate)));
}
// Frames of a queue's past or future: as set, else the model's seconds, if it has them.
inline int queue_frames(std::optional<int> set, std::optional<double> seconds, double frame_rate) {
  if (set) return std::max(whole_past, *set);
  return seconds ? queue_frames(*seconds, frame_rate) : whole_past;
}

class Trajectory {
 public:
  // `values`: modelled output values; the rest are frames. P is whole_past, or 0 or more; C is at
  // least 1.
  Trajectory(int values, int past, int current, int future);

  // Takes the next frame's Gaussian (3 * values entries each) into the queue.
  void push(const OutputGaussian& gaussian) noexcept;

  // Whether `current` frames can leave: the queue holds current + future frames or more, and
  // `current` were pushed since the last time.
  bool ready() const noexcept;

  // Solves the queue and gives its current frames, values by C, oldest first. Valid until the next
  // call.
  Eigen::Ref<const Eigen::MatrixXf> generate() noexcept;

  // For the end of a stream: the queue's last `count` frames, values by count, at most delay() + 1
  // of them; what was still in the future.
  Eigen::Ref<const Eigen::MatrixXf> flush(int count) noexcept;

  int delay() const noexcept { return future_ + current_ - 1; }  // frames
  int filled() const noexcept { return filled_; }                // frames in the queue
  int past() const noexcept { return past_; }
  int future() const noexcept { return future_; }
  void reset() noexcept;
  // A longer or shorter queue, in which the newest frames stay. This one allocates.
  void resize(int past, int future);

 private:
  // Values are computed four at a time.
  static constexpr int lanes = 4;
  using Block = Eigen::Array<double, lanes, 1>;
  using FloatBlock = Eigen::Array<float, lanes, 1>;

  struct Frame {  // inverse variance and mean of each part
    FloatBlock weight[3], target[3];
  };
  // The system's rows of the last two frames without those before, which are eliminated: later
  // frames still change them.
  struct Ends {
    Block before, between, last;  // diagonal, off-diagonal, diagonal
    Block right_before, right_last;
  };
  // A frame that is eliminated: its value is start - next * (that of the next) - second * (that of
  // the second next).
  struct Eliminated {
    FloatBlock start, next, second;
  };

  bool carried() const noexcept { return past_ == whole_past; }
  int blocks() const noexcept { return static_cast<int>(ends_.size()); }
  void forget(Ends& ends) const noexcept;
  void factor(int block, int i) noexcept;
  void solve(int later, int count) noexcept;
  // Place in the ring of the queue's frame `i`, 0 the oldest.
  int place(int block, int i) const noexcept {
    const int at = newest_ + 1 + i - filled_;
    return block * length_ + (at < 0 ? at + length_ : at);
  }

  int values_, past_, current_, future_, length_;
  int newest_ = 0, filled_ = 0, fresh_ = 0;
  // Rings, block after block: the queue's frames and, of the older ones, the factors.
  std::vector<Frame> frames_;
  std::vector<Eliminated> eliminated_;
  std::vector<Ends> ends_;  // a block each
  Eigen::MatrixXf path_;
};

}  // namespace gait
