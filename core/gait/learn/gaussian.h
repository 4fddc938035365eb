// Gaussian over observations, with its covariance factorised for the log-likelihoods of many
// frames.
#pragma once

#include <Eigen/Dense>
#include <numbers>

namespace gait {

class Gaussian {
 public:
  // `covariance` must be positive definite; `valid` returns whether it is.
  Gaussian(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance)
      : mean_(mean), factor_(covariance) {
    half_log_determinant_ = factor_.matrixLLT().diagonal().array().log().sum();
  }

  bool valid() const {
    return factor_.info() == Eigen::Success && std::isfinite(half_log_determinant_);
  }
  double log_determinant() const { return 2 * half_log_determinant_; }
  const Eigen::LLT<Eigen::MatrixXd>& factor() const { return factor_; }

  // One per column of `frames`.
  Eigen::VectorXd log_likelihoods(const Eigen::Ref<const Eigen::MatrixXd>& frames) const {
    Eigen::MatrixXd white = frames.colwise() - mean_;
    factor_.matrixL().solveInPlace(white);
    const double constant = half_log_determinant_ + 0.5 * static_cast<double>(mean_.size()) *
                                                        std::log(2 * std::numbers::pi);
    return (-0.5 * white.colwise().squaredNorm().array() - constant).transpose();
  }

 private:
  Eigen::VectorXd mean_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  double half_log_determinant_ = 0;
};

}  // namespace gait
