// The whole path through Gaussians, solved at once in double: W^T V^-1 W c = W^T V^-1 mu by a
// general sparse factorisation.
#pragma once

#include <Eigen/Sparse>
#include <span>
#include <vector>

#include "gait/motion/observation.h"

namespace gait::testing {

struct ValueGaussian {  // of one output value at one frame: static, first, second difference
  double mean[3], variance[3];
};

inline Eigen::VectorXd direct_path(std::span<const ValueGaussian> frames) {
  const auto size = static_cast<Eigen::Index>(frames.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  const auto add = [&](Eigen::Index frame, int part, std::span<const double> window, int reach) {
    const ValueGaussian& gaussian = frames[static_cast<std::size_t>(frame)];
    const double weight = 1 / gaussian.variance[part];
    for (int i = -reach; i <= reach; ++i) {
      right[frame + i] += window[i + reach] * weight * gaussian.mean[part];
      for (int j = -reach; j <= reach; ++j)
        entries.emplace_back(frame + i, frame + j, window[i + reach] * weight * window[j + reach]);
    }
  };
  const std::vector<double> one{1};
  const std::vector<double> first(std::begin(first_difference), std::end(first_difference));
  const std::vector<double> second(std::begin(second_difference), std::end(second_difference));
  for (Eigen::Index frame = 0; frame < size; ++frame) add(frame, 0, one, 0);
  for (Eigen::Index frame = 1; frame + 1 < size; ++frame) {
    add(frame, 1, first, 1);
    add(frame, 2, second, 1);
  }
  Eigen::SparseMatrix<double> system(size, size);
  system.setFromTriplets(entries.begin(), entries.end());
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(system).solve(right);
}

}  // namespace gait::testing
