#include "gait/play/cycles/cycle_projector.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gait {

CycleProjector::CycleProjector(std::shared_ptr<const Model> model, const CycleSpace& space)
    : model_(std::move(model)),
      space_(space),
      inverse_deviation_(space.variances.head(space.kept())
                             .cwiseSqrt()
                             .cwiseMax(1e-9)
                             .cwiseInverse()
                             .cast<float>()),
      newest_(3 * static_cast<Eigen::Index>(space.joints.size())),
      kept_(newest_.size(), most_kept),
      scores_(Eigen::VectorXf::Zero(space.kept())),
      frame_(newest_.size()),
      sums_(space.kept()) {}

bool CycleProjector::add(std::span<const float> pose) noexcept {
  if (pose.size() != 3 * model_->body->skeleton.joints.size()) return false;
  if (count_ == most_frames) {
    whole_ = false;
    return true;
  }
  Eigen::Index at = 0;
  for (const int joint : space_.joints)
    for (int axis = 0; axis < 3; ++axis) {
      const float number = pose[static_cast<std::size_t>(3 * joint + axis)];
      newest_[at++] = std::isfinite(number) ? number : 0;
    }
  keep();
  ++count_;
  return true;
}

// Keeps the newest frame if it is due; where there is no room, every second one goes.
void CycleProjector::keep() noexcept {
  if (count_ == stride_ * most_kept) {
    stride_ *= 2;
    for (int i = 1; 2 * i < most_kept; ++i) kept_.col(i) = kept_.col(2 * i);
  }
  if (count_ % stride_ == 0) kept_.col(count_ / stride_) = newest_;
}

bool CycleProjector::contact(Foot foot) noexcept {
  if (count_ == 0) return false;
  const int last = count_ - 1;  // the frame of the contact
  if (foot == Foot::left) {
    left_ = last;
    return false;
  }
  // Two frames a step at least: less is no walk.
  const bool complete = whole_ && last >= 4;
  if (complete) {
    if (left_ < 2 || left_ > last - 2) left_ = 0;
    project();
  }
  kept_.col(0) = newest_;
  count_ = stride_ = 1, left_ = 0;
  whole_ = true;
  return complete;
}

// The pose so many frames after the right contact, linearly between those kept: they are some
// hundredths of a second apart, where SLERP is the same to 1e-4 rad.
void CycleProjector::frame_at(double frames) noexcept {
  const int last = count_ - 1, first = std::min(static_cast<int>(frames) / stride_, last / stride_);
  const int before = first * stride_, after = std::min(before + stride_, last);
  const auto share =
      after > before ? static_cast<float>((frames - before) / (after - before)) : 0.0f;
  const auto from = kept_.col(first);
  if (after % stride_ == 0)
    frame_ = (from + share * (kept_.col(after / stride_) - from)).cast<double>();
  else
    frame_ = (from + share * (newest_ - from)).cast<double>();
}

void CycleProjector::project() noexcept {
  const double length = count_ - 1, half = left_ > 0 ? left_ : length / 2;
  const int frames = space_.frames, frames_half = frames / 2;
  const Eigen::Index size = newest_.size();
  sums_.setZero();
  for (int k = 0; k < frames; ++k) {
    frame_at(k < frames_half ? half * k / frames_half
                             : half + (length - half) * (k - frames_half) / (frames - frames_half));
    frame_ -= space_.mean.segment(k * size, size);
    sums_.noalias() += space_.components.middleRows(k * size, size).transpose() * frame_;
  }
  scores_ = sums_.cast<float>().cwiseProduct(inverse_deviation_);
}

void CycleProjector::reset() noexcept {
  count_ = left_ = 0, stride_ = 1;
  whole_ = false;
}

}  // namespace gait
