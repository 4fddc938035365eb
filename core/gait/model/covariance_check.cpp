#include "gait/model/covariance_check.h"

#include <cmath>

#include "gait/error.h"

namespace gait {

namespace {

// The least variance, and the least share of a dimension's variance that those before it may leave
// unexplained: what is below is rounding, and its inverse would be noise.
constexpr double least_variance_of_states = 1e-12;
constexpr double least_share = 1e-12;
// Of the standard deviations: how far two halves may differ by the order of summation.
constexpr double most_asymmetry = 1e-9;

bool symmetric(const Eigen::MatrixXd& matrix, double tolerance) {
  for (Eigen::Index column = 0; column < matrix.cols(); ++column)
    for (Eigen::Index row = column + 1; row < matrix.rows(); ++row)
      if (std::abs(matrix(row, column) - matrix(column, row)) > tolerance) return false;
  return true;
}

}  // namespace

void CovarianceCheck::expect(const Eigen::MatrixXd& covariance, const std::string& field) {
  if (covariance.size() == 0) return;
  const auto variances = covariance.diagonal().array();
  if (!symmetric(covariance, most_asymmetry * variances.abs().maxCoeff()))
    throw Error(field + ": expected a symmetric matrix");
  factor_.compute(covariance);
  if (factor_.info() != Eigen::Success || !(variances >= least_variance_of_states).all() ||
      !(factor_.matrixLLT().diagonal().array().square() >= least_share * variances).all())
    throw Error(field + ": expected a positive definite matrix");
}

}  // namespace gait
