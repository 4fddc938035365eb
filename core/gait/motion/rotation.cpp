#include "gait/motion/rotation.h"

#include <Eigen/Eigenvalues>

namespace gait {

Eigen::Quaterniond chordal_mean(std::span<const Eigen::Quaterniond> rotations) {
  if (rotations.empty()) return Eigen::Quaterniond::Identity();
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const auto& q : rotations) sum += q.coeffs() * q.coeffs().transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(sum);
  return short_way(Eigen::Quaterniond(Eigen::Vector4d(solver.eigenvectors().col(3))));
}

Eigen::Quaterniond turn_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) noexcept {
  const Eigen::Vector3d a = from.stableNormalized(), b = to.stableNormalized();
  const double cosine = a.dot(b);
  if (cosine < -1 + 1e-12) {  // half a turn about anything across
    const Eigen::Vector3d axis = a.unitOrthogonal();
    return {0, axis.x(), axis.y(), axis.z()};
  }
  const Eigen::Vector3d axis = a.cross(b);
  const double scale = std::sqrt(2 * (1 + cosine));
  return Eigen::Quaterniond(scale / 2, axis.x() / scale, axis.y() / scale, axis.z() / scale);
}

}  // namespace gait
