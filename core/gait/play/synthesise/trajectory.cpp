#include "gait/play/synthesise/trajectory.h"

#include <algorithm>
#include <utility>

namespace gait {

Trajectory::Trajectory(int values, int past, int current, int future)
    : values_(values),
      past_(std::max(0, past)),
      current_(std::max(1, current)),
      future_(std::max(0, future)),
      length_(past_ + current_ + future_) {
  for (int part = 0; part < 3; ++part) {
    weight_[part].setZero(values, length_);
    target_[part].setZero(values, length_);
  }
  for (Eigen::ArrayXXf* band : {&diagonal_, &off_, &far_, &right_}) band->setZero(values, length_);
  path_.setZero(values, length_);
}

void Trajectory::push(const OutputGaussian& gaussian) noexcept {
  newest_ = (newest_ + 1) % length_;
  filled_ = std::min(filled_ + 1, length_);
  fresh_ = std::min(fresh_ + 1, current_);
  for (int part = 0; part < 3; ++part) {
    weight_[part].col(newest_) =
        gaussian.variance.segment(part * values_, values_).array().inverse();
    target_[part].col(newest_) = gaussian.mean.segment(part * values_, values_).array();
  }
}

void Trajectory::resize(int past, int future) {
  Trajectory other(values_, past, current_, future);
  other.filled_ = std::min(filled_, other.length_);
  other.fresh_ = fresh_;
  other.newest_ = std::max(0, other.filled_ - 1);
  for (int i = 0; i < other.filled_; ++i)
    for (int part = 0; part < 3; ++part) {
      const int from = column(filled_ - other.filled_ + i);
      other.weight_[part].col(i) = weight_[part].col(from);
      other.target_[part].col(i) = target_[part].col(from);
    }
  *this = std::move(other);
}

bool Trajectory::ready() const noexcept {
  return fresh_ >= current_ && filled_ >= current_ + future_;
}

void Trajectory::solve() noexcept {
  for (int i = 0; i < filled_; ++i) {
    const int at = column(i);
    diagonal_.col(i) = weight_[0].col(at);
    right_.col(i) = weight_[0].col(at) * target_[0].col(at);
    off_.col(i).setZero();
    far_.col(i).setZero();
  }
  // The window at frame i has the coefficients w on frames i-1, i, i+1: it adds w w^T / variance.
  for (int i = 1; i + 1 < filled_; ++i) {
    const int at = column(i);
    const auto first = weight_[1].col(at), second = weight_[2].col(at);
    diagonal_.col(i - 1) += 0.25f * first + second;
    diagonal_.col(i) += 4.0f * second;
    diagonal_.col(i + 1) += 0.25f * first + second;
    off_.col(i - 1) -= 2.0f * second;
    off_.col(i) -= 2.0f * second;
    far_.col(i - 1) += second - 0.25f * first;
    right_.col(i - 1) += second * target_[2].col(at) - 0.5f * first * target_[1].col(at);
    right_.col(i) -= 2.0f * second * target_[2].col(at);
    right_.col(i + 1) += second * target_[2].col(at) + 0.5f * first * target_[1].col(at);
  }
  // L D L^T in place: off_ and far_ become L's columns, diagonal_ becomes 1/D, right_ L^-1 b.
  for (int i = 0; i < filled_; ++i) {
    diagonal_.col(i) = diagonal_.col(i).inverse();
    if (i + 1 < filled_) {
      right_.col(i + 1) -= off_.col(i) * diagonal_.col(i) * right_.col(i);
      diagonal_.col(i + 1) -= off_.col(i).square() * diagonal_.col(i);
      off_.col(i + 1) -= off_.col(i) * diagonal_.col(i) * far_.col(i);
    }
    if (i + 2 < filled_) {
      right_.col(i + 2) -= far_.col(i) * diagonal_.col(i) * right_.col(i);
      diagonal_.col(i + 2) -= far_.col(i).square() * diagonal_.col(i);
    }
  }
}

// Back substitution from the newest frame to frame `first` of the queue.
void Trajectory::substitute(int first) noexcept {
  const int last = filled_ - 1;
  for (int i = last; i >= first; --i) {
    path_.col(i) = (right_.col(i) * diagonal_.col(i)).matrix();
    if (i + 1 <= last)
      path_.col(i).array() -= off_.col(i) * diagonal_.col(i) * path_.col(i + 1).array();
    if (i + 2 <= last)
      path_.col(i).array() -= far_.col(i) * diagonal_.col(i) * path_.col(i + 2).array();
  }
}

Eigen::Ref<const Eigen::MatrixXf> Trajectory::generate() noexcept {
  fresh_ = 0;
  solve();
  const int first = std::max(0, filled_ - current_ - future_);
  substitute(first);
  return path_.middleCols(first, std::min(current_, filled_));
}

Eigen::Ref<const Eigen::MatrixXf> Trajectory::flush(int count) noexcept {
  count = std::min(count, filled_);
  solve();
  substitute(filled_ - count);
  return path_.middleCols(filled_ - count, count);
}

}  // namespace gait
