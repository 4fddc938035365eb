#include "gait/learn/principal_components.h"

#include <Eigen/Dense>
#include <algorithm>
#include <string>

#include "gait/error.h"

namespace gait {

namespace {

int kept(const Eigen::VectorXd& variances, const ComponentChoice& choice) {
  const int all = static_cast<int>(variances.size());
  if (choice.count > 0) return std::min(choice.count, all);
  const double wanted = choice.share * variances.sum();
  const int most = choice.most > 0 ? std::min(choice.most, all) : all;
  double sum = 0;
  for (int i = 0; i < most; ++i) {
    sum += variances[i];
    if (sum >= wanted) return i + 1;
  }
  return most;
}

}  // namespace

PrincipalComponents principal_components(Eigen::MatrixXd& rows, const ComponentChoice& choice) {
  if (rows.rows() < 2)
    throw Error("expected at least two cycles to find components in; found " +
                std::to_string(rows.rows()));
  if (!rows.allFinite()) throw Error("expected finite values in all cycles");
  PrincipalComponents result;
  result.mean = rows.colwise().mean();
  rows.rowwise() -= result.mean.transpose();

  const bool few = rows.rows() <= rows.cols();
  const Eigen::Index side = few ? rows.rows() : rows.cols();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(side, side);
  if (few)
    gram.selfadjointView<Eigen::Lower>().rankUpdate(rows);
  else
    gram.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  if (solver.info() != Eigen::Success) throw Error("principal components did not converge");

  // Ascending there, descending here; centring leaves one direction without variance.
  const Eigen::Index count = std::min(rows.rows() - 1, rows.cols());
  result.variances = solver.eigenvalues().reverse().head(count).cwiseMax(0.0) /
                     static_cast<double>(rows.rows() - 1);
  const int components = kept(result.variances, choice);
  const auto vectors = solver.eigenvectors().rightCols(components).rowwise().reverse();
  if (few) {
    result.components.noalias() = rows.transpose() * vectors;
    // Scaling by the root of the eigenvalue would lose digits where it is small.
    for (int i = 0; i < components; ++i) result.components.col(i).normalize();
  } else {
    result.components = vectors;
  }
  // The same data gives the same signs whatever the solver did.
  for (int i = 0; i < components; ++i) {
    Eigen::Index largest = 0;
    result.components.col(i).cwiseAbs().maxCoeff(&largest);
    if (result.components(largest, i) < 0) result.components.col(i) *= -1;
  }
  return result;
}

}  // namespace gait
