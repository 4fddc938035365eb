#include "gait/play/change/style_mix.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

constexpr float step = 0.5f;  // cycles

}  // namespace

StyleMix::StyleMix(std::vector<bool> can_walk, const Eigen::VectorXf& neutral)
    : can_walk_(std::move(can_walk)), neutral_(neutral), wanted_(neutral), weights_(neutral) {
  for (const float weight : neutral) glides_.emplace_back(weight);
}

bool StyleMix::set(std::span<const float> weights) noexcept {
  if (weights.size() != glides_.size()) return false;
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!std::isfinite(weights[i]) || weights[i] < 0) return false;
    if (weights[i] > 0 && !can_walk_[i]) return false;
    sum += weights[i];
  }
  if (!(sum > 0)) return false;
  const int before = strongest(wanted_);
  for (std::size_t i = 0; i < weights.size(); ++i)
    wanted_[static_cast<Eigen::Index>(i)] = static_cast<float>(weights[i] / sum);
  go(before);
  return true;
}

bool StyleMix::set_only(int style) noexcept {
  if (style < 0 || style >= wanted_.size() || !can_walk_[static_cast<std::size_t>(style)])
    return false;
  const int before = strongest(wanted_);
  wanted_.setZero();
  wanted_[style] = 1;
  go(before);
  return true;
}

void StyleMix::go(int strongest_before) noexcept {
  // A slider that moves within a mix does not go round by neutral while the strongest style stays.
  if (through_neutral_ && to_neutral_ <= 0 && strongest(wanted_) != strongest_before)
    to_neutral_ = step / 2, since_passed_ = 0;
}

void StyleMix::advance(float cycles) noexcept {
  // With half the way each, twice as fast.
  const bool passing = to_neutral_ > 0 || since_passed_ < step / 2;
  if (to_neutral_ > 0)
    to_neutral_ -= cycles;
  else if (passing)
    since_passed_ += cycles;
  const Eigen::VectorXf& target = to_neutral_ > 0 ? neutral_ : wanted_;
  const float share = glide_share(cycles, passing ? step / 2 : step);
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    Glide& glide = glides_[static_cast<std::size_t>(i)];
    glide.set(target[i]);
    glide.advance(share);
    weights_[i] = glide.value();
  }
  weights_ /= weights_.sum();
}

void StyleMix::arrive() noexcept {
  to_neutral_ = 0, since_passed_ = 1;
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    Glide& glide = glides_[static_cast<std::size_t>(i)];
    glide.set(wanted_[i]);
    glide.arrive();
    weights_[i] = wanted_[i];
  }
}

int StyleMix::strongest(const Eigen::VectorXf& weights) const noexcept {
  Eigen::Index best = 0;
  weights.maxCoeff(&best);
  return static_cast<int>(best);
}

}  // namespace gait
