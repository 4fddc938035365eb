#include "gait/judge/calibration.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

double log_loss(const StyleScores& scores, double temper) {
  double loss = 0;
  for (std::size_t i = 0; i < scores.truth.size(); ++i) {
    const Eigen::ArrayXd tempered = temper * scores.scores[i].array().cast<double>();
    const double largest = tempered.maxCoeff();
    loss += largest + std::log((tempered - largest).exp().sum()) - tempered[scores.truth[i]];
  }
  return loss;
}

}  // namespace

double best_temper(const StyleScores& scores, double otherwise) {
  if (scores.truth.empty()) return otherwise;
  // The loss is convex in the temper: golden section on a logarithmic scale finds its minimum. At
  // most 1, the evidence of one frame: few held-out clips recognised without a miss are no ground
  // for more.
  constexpr double golden = 0.6180339887498949;
  double low = std::log(1e-4), high = 0;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double loss_a = log_loss(scores, std::exp(a)), loss_b = log_loss(scores, std::exp(b));
  for (int i = 0; i < 24; ++i) {
    if (loss_a < loss_b) {
      high = b, b = a, loss_b = loss_a;
      a = high - golden * (high - low);
      loss_a = log_loss(scores, std::exp(a));
    } else {
      low = a, a = b, loss_a = loss_b;
      b = low + golden * (high - low);
      loss_b = log_loss(scores, std::exp(b));
    }
  }
  return std::exp((low + high) / 2);
}

void CalibrationError::add(double probability, bool right) {
  const int bin = std::clamp(static_cast<int>(probability * bins), 0, bins - 1);
  probability_[bin] += probability;
  right_[bin] += right;
  count_[bin] += 1;
}

double CalibrationError::value() const {
  double gap = 0, count = 0;
  for (int bin = 0; bin < bins; ++bin) {
    gap += std::abs(probability_[bin] - right_[bin]);
    count += count_[bin];
  }
  return count > 0 ? gap / count : 0;
}

}  // namespace gait
