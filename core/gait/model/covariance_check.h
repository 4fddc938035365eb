// Whether covariances are ones: symmetric and positive definite, with room to spare for float.
#pragma once

#include <Eigen/Cholesky>
#include <string>

namespace gait {

class CovarianceCheck {
 public:
  // Throws Error naming `field`. Entries must be finite. Nothing is wrong with an empty matrix.
  void expect(const Eigen::MatrixXd& covariance, const std::string& field);

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;  // kept: its storage serves for all
};

}  // namespace gait
