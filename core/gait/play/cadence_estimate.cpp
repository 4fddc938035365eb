#include "gait/play/cadence_estimate.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gait/error.h"

namespace gait {

namespace {

constexpr double least_travel = 0.5;  // labels; less says nothing of a slope

}  // namespace

CadenceEstimator::CadenceEstimator(double frame_rate, double longest) : frame_rate_(frame_rate) {
  if (!std::isfinite(frame_rate) || frame_rate <= 0)
    throw Error("cadence: expected a positive frame rate, found " + std::to_string(frame_rate));
  if (!(longest > 0) || longest > 60)
    throw Error("cadence: expected to look back between 0 and 60 s, found " +
                std::to_string(longest));
  positions_.assign(static_cast<std::size_t>(std::max(2.0, std::ceil(longest * frame_rate))), 0.0);
}

void CadenceEstimator::reset() noexcept {
  count_ = labels_ = 0;
  cadence_ = 0;
}

void CadenceEstimator::advance(double phase, int labels) noexcept {
  if (!std::isfinite(phase)) return;
  if (labels != labels_) reset();
  const int size = static_cast<int>(positions_.size());
  double moved = 0;
  if (count_ > 0) {
    moved = phase - phase_;
    moved -= std::round(moved);
  }
  const double position = count_ > 0 ? positions_[newest_] + moved * labels : 0;
  phase_ = phase;
  labels_ = labels;
  newest_ = (newest_ + 1) % size;
  positions_[newest_] = position;
  count_ = std::min(count_ + 1, size);

  // Least squares over the frames of the last cycle; i counts frames back.
  double n = 0, sum_i = 0, sum_ii = 0, sum_p = 0, sum_ip = 0, travelled = 0;
  for (int i = 0; i < count_ && travelled < labels; ++i) {
    travelled = position - positions_[(newest_ - i + size) % size];
    n += 1, sum_i += i, sum_ii += static_cast<double>(i) * i;
    sum_p += travelled, sum_ip += i * travelled;
  }
  if (n < 2) return;
  const double slope = (n * sum_ip - sum_i * sum_p) / (n * sum_ii - sum_i * sum_i);
  // Who has not moved by half a label within all that is remembered stands.
  if (travelled >= least_travel || count_ == size)
    cadence_ = static_cast<float>(std::max(0.0, slope) * frame_rate_);
}

}  // namespace gait
