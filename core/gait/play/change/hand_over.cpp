#include "gait/play/change/hand_over.h"

#include <algorithm>
#include <cmath>

namespace gait {

HandOver::HandOver(int values, double frame_rate, double seconds)
    : place_(Eigen::VectorXf::Zero(values)),
      speed_(place_),
      offset_(place_),
      frames_(std::max(1, static_cast<int>(std::lround(seconds * frame_rate)))),
      frame_(frames_) {}

void HandOver::begin(const Eigen::Ref<const Eigen::VectorXf>& offset,
                     const Eigen::Ref<const Eigen::VectorXf>& before) noexcept {
  place_ = offset;
  speed_ = offset - before;
  frame_ = 0;
}

const Eigen::VectorXf& HandOver::advance() noexcept {
  if (++frame_ >= frames_) {
    frame_ = frames_;
    offset_.setZero();
    return offset_;
  }
  const auto whole = static_cast<float>(frames_), t = static_cast<float>(frame_) / whole;
  const float t3 = t * t * t;
  const float of_place = 1 - t3 * (10 - t * (15 - 6 * t));
  const float of_speed = t - t3 * (6 - t * (8 - 3 * t));
  offset_ = of_place * place_ + (of_speed * whole) * speed_;
  return offset_;
}

}  // namespace gait
