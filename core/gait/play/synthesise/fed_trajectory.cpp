#include "gait/play/synthesise/fed_trajectory.h"

#include <algorithm>

namespace gait {

FedTrajectory::FedTrajectory(const Model& model, int past, int current, int future)
    : modelled_(model.output.modelled),
      easing_(static_cast<float>(model.play.easing)),
      trajectory_(model.output.statics(), past, current, future),
      gaussian_{Eigen::VectorXf::Zero(model.output.size()),
                Eigen::VectorXf::Ones(model.output.size())},
      told_(model.output_mean.cast<float>().replicate(1, trajectory_.delay() + 1)),
      path_(Eigen::MatrixXf::Zero(model.output.statics(), std::max(1, current))),
      values_(model.output_mean.cast<float>()) {}

void FedTrajectory::reset() noexcept {
  trajectory_.reset();
  held_ = solved_ = 0;
  flushed_ = false;
}

void FedTrajectory::resize(int past, int future) {
  trajectory_.resize(past, future);
  held_ = std::min(trajectory_.filled(), trajectory_.delay() - solved_);
  solved_ = 0;
  const int length = trajectory_.delay() + 1, before = static_cast<int>(told_.cols());
  Eigen::MatrixXf told(told_.rows(), length);
  for (int back = 0; back < length; ++back)
    told.col(length - 1 - back) =
        told_.col((newest_ - std::min(back, before - 1) + before) % before);
  told_ = std::move(told);
  newest_ = length - 1;
}

bool FedTrajectory::push(std::span<const float> means, std::span<const float> variances) noexcept {
  const Eigen::Index values = values_.size(), moved = path_.rows();
  for (Eigen::Index part = 0; part < 3; ++part) {
    const float eased = part == 0 ? 1 : easing_;
    for (Eigen::Index i = 0; i < moved; ++i) {
      const auto at = static_cast<std::size_t>(part * values + modelled_[i]);
      gaussian_.mean[part * moved + i] = means[at];
      gaussian_.variance[part * moved + i] = eased * variances[at];
    }
  }
  newest_ = (newest_ + 1) % static_cast<int>(told_.cols());
  told_.col(newest_) = Eigen::Map<const Eigen::VectorXf>(means.data(), values);
  trajectory_.push(gaussian_);
  ++held_;
  if (trajectory_.ready()) {
    path_ = trajectory_.generate();
    solved_ = static_cast<int>(path_.cols());
  }
  if (solved_ == 0) return false;
  leave(path_.col(path_.cols() - solved_--));
  return true;
}

bool FedTrajectory::flush() noexcept {
  if (held_ == 0) return false;
  flushed_ = true;
  if (solved_ > 0)
    leave(path_.col(path_.cols() - solved_--));
  else
    leave(trajectory_.flush(held_).col(0));
  return true;
}

void FedTrajectory::leave(const Eigen::Ref<const Eigen::VectorXf>& modelled) noexcept {
  --held_;
  const int length = static_cast<int>(told_.cols());
  values_ = told_.col((newest_ - held_ + length) % length);
  for (Eigen::Index i = 0; i < modelled.size(); ++i) values_[modelled_[i]] = modelled[i];
}

}  // namespace gait
