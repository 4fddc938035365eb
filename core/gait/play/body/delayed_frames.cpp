#include "gait/play/body/delayed_frames.h"

#include <algorithm>

namespace gait {

namespace {

// Counts start again from here before they overflow; a multiple of both rings' sizes.
constexpr int far = 1 << 29;

}  // namespace

DelayedFrames::DelayedFrames(const Eigen::VectorXf& first)
    : frames_(first.replicate(1, capacity)), first_(first) {}

void DelayedFrames::reset() noexcept {
  stored_ = marked_ = 0;
  frames_.col(0) = first_;
}

std::span<const float> DelayedFrames::frame(int number) const noexcept {
  return {frames_.col(number % capacity).data(), static_cast<std::size_t>(frames_.rows())};
}

void DelayedFrames::store(std::span<const float> values) noexcept {
  if (static_cast<Eigen::Index>(values.size()) != frames_.rows()) return;
  if (++stored_ >= 2 * far) {
    stored_ -= far;
    for (int& mark : marks_) mark = std::max(0, mark - far);
  }
  std::ranges::copy(values, frames_.col(stored_ % capacity).data());
}

void DelayedFrames::mark() noexcept {
  if (++marked_ >= 2 * far) marked_ -= far;
  marks_[static_cast<std::size_t>(marked_) % marks_.size()] = stored_;
}

std::span<const float> DelayedFrames::at(int delay) const noexcept {
  delay = std::clamp(delay, 0, longest_delay);
  const int number = marked_ > delay
                         ? marks_[static_cast<std::size_t>(marked_ - delay) % marks_.size()]
                         : stored_ - delay;
  // What was stored first stands for all that came before it.
  const int oldest = stored_ == 0 ? 0 : std::max(1, stored_ - capacity + 1);
  return frame(std::clamp(number, oldest, stored_));
}

}  // namespace gait
