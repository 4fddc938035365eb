// State statistics: sufficient statistics of states over z = [x; y] under an alignment. They are
// additive, so any part of the training data can be subtracted (cross-validation).
#pragma once

#include <vector>

#include "gait/learn/alignment.h"
#include "gait/learn/sequence.h"

namespace gait {

struct StateStatistics {
  double count = 0;              // frames, by share
  Eigen::VectorXd sum;           // of z
  Eigen::MatrixXd products;      // sum of z z^T
  Eigen::VectorXd style_counts;  // per style
  Eigen::MatrixXd style_sums;    // z by styles

  StateStatistics() = default;
  StateStatistics(int dimensions, int styles);
  StateStatistics& operator+=(const StateStatistics& other);
  StateStatistics& operator-=(const StateStatistics& other);

  Eigen::VectorXd mean() const { return sum / count; }
  // Maximum-likelihood covariance S.
  Eigen::MatrixXd covariance() const;
  // Covariance about each style's own mean, of the leading `dimensions` entries.
  Eigen::MatrixXd within_style_covariance(int dimensions) const;
};

// Statistics of every state over the sequences with the indices `chosen`; identical for any number
// of threads.
std::vector<StateStatistics> gather(const std::vector<ObservedSequence>& sequences,
                                    const std::vector<Alignment>& alignments,
                                    const std::vector<int>& chosen, int states, int styles,
                                    int threads);

}  // namespace gait
