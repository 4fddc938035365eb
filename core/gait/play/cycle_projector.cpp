#include "gait/play/cycle_projector.h"

#include <algorithm>
#include <cmath>

#include "gait/motion/rotation.h"

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

// Between two frames, by SLERP.
CycleProjector::Vector CycleProjector::value(double frame, std::size_t joint) const noexcept {
  const int first = std::clamp(static_cast<int>(frame), 0, count_ - 1);
  const int second = std::min(first + 1, count_ - 1);
  const auto row = static_cast<Eigen::Index>(3 * joint);
  const Vector a = taken_.block<3, 1>(row, first), b = taken_.block<3, 1>(row, second);
  const auto share = static_cast<float>(frame - first);
  return rotation_vector<float>(exponential_map<float>(a).slerp(share, exponential_map<float>(b)));
}

void CycleProjector::project() noexcept {
  const double length = count_ - 1, half = left_ > 0 ? left_ : length / 2;
  const int frames_half = frames_ / 2;
  const auto size = static_cast<Eigen::Index>(3 * joints_.size());
  for (int k = 0; k < frames_; ++k) {
    const double at = k < frames_half
                          ? half * k / frames_half
                          : half + (length - half) * (k - frames_half) / (frames_ - frames_half);
    for (std::size_t joint = 0; joint < joints_.size(); ++joint)
      cycle_.segment<3>(k * size + static_cast<Eigen::Index>(3 * joint)) = value(at, joint);
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
