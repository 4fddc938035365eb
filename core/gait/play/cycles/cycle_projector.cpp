#include "gait/play/cycles/cycle_projector.h"

#include <algorithm>
#include <cmath>

namespace gait {

CycleProjector::CycleProjector(const CycleSpace& space, const Body& body)
    : frames_(space.frames),
      pose_values_(3 * body.skeleton.size()),
      joints_(space.joints),
      mean_(space.mean.cast<float>()),
      components_(space.components.cast<float>()),
      inverse_deviation_(space.variances.head(space.kept())
                             .cwiseSqrt()
                             .cwiseMax(1e-9)
                             .cwiseInverse()
                             .cast<float>()),
      taken_(3 * static_cast<Eigen::Index>(space.joints.size()), most_frames),
      cycle_(space.values()),
      scores_(Eigen::VectorXf::Zero(space.kept())) {}

bool CycleProjector::add(std::span<const float> pose) noexcept {
  if (pose.size() != static_cast<std::size_t>(pose_values_)) return false;
  if (count_ == most_frames) {
    whole_ = false;
    return true;
  }
  for (std::size_t i = 0; i < joints_.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const float number = pose[static_cast<std::size_t>(3 * joints_[i] + axis)];
      taken_(static_cast<Eigen::Index>(3 * i) + axis, count_) = std::isfinite(number) ? number : 0;
    }
  ++count_;
  return true;
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
  if (last > 0) taken_.col(0) = taken_.col(last);
  count_ = 1, left_ = 0;
  whole_ = true;
  return complete;
}

void CycleProjector::project() noexcept {
  const double length = count_ - 1, half = left_ > 0 ? left_ : length / 2;
  const int frames_half = frames_ / 2;
  const auto size = static_cast<Eigen::Index>(3 * joints_.size());
  for (int k = 0; k < frames_; ++k) {
    const double at = k < frames_half
                          ? half * k / frames_half
                          : half + (length - half) * (k - frames_half) / (frames_ - frames_half);
    // Linearly: frames are some hundredths of a second apart, where SLERP is the same to 1e-4 rad.
    const int first = std::clamp(static_cast<int>(at), 0, count_ - 1);
    const int second = std::min(first + 1, count_ - 1);
    const auto share = static_cast<float>(at - first);
    cycle_.segment(k * size, size) =
        taken_.col(first) + share * (taken_.col(second) - taken_.col(first));
  }
  cycle_ -= mean_;
  scores_.noalias() = components_.transpose() * cycle_;
  scores_.array() *= inverse_deviation_.array();
}

void CycleProjector::reset() noexcept {
  count_ = left_ = 0;
  whole_ = false;
}

}  // namespace gait
