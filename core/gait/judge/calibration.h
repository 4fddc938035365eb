// Calibration: whether a style said with probability p is right in a share p of the cases.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace gait {

// Style scores of many frames with the true styles, to find the temper of their softmax.
struct StyleScores {
  std::vector<Eigen::VectorXf> scores;  // per frame: averaged, untempered, one per style
  std::vector<int> truth;               // per frame
};

// The exponent that makes softmax(temper * scores) most likely; `otherwise` without frames.
double best_temper(const StyleScores& scores, double otherwise);

// Expected calibration error (Guo et al. 2017): mean gap between the best style's probability and
// the share of right ones, over ten bins of probability weighted by their frames. 0 to 1.
class CalibrationError {
 public:
  void add(double probability, bool right);
  double value() const;

 private:
  static constexpr int bins = 10;
  double probability_[bins] = {}, right_[bins] = {}, count_[bins] = {};
};

}  // namespace gait
