// Principal component analysis (T10 §5, eq. 1) of few long rows or of many.
#pragma once

#include <Eigen/Core>

namespace gait {

struct PrincipalComponents {
  Eigen::VectorXd mean;        // of the rows
  Eigen::MatrixXd components;  // columns: orthonormal directions, the most variance first
  Eigen::VectorXd variances;   // of all min(rows - 1, columns) components, descending
};

// Number of components to keep: `count` when it is not 0, else as many as carry `share` of the
// variance, at most `most` when that is not 0.
struct ComponentChoice {
  double share = 0.9;
  int count = 0;
  int most = 0;
};

// Mean-centred analysis of `rows` (observations by values) by the eigenvectors of the Gram matrix
// of its smaller side: as exact as a dense SVD for what is kept, and its memory beside the data is
// that of the smaller side squared. `rows` is centred in place. Throws Error with fewer than two
// rows or values that are not finite.
PrincipalComponents principal_components(Eigen::MatrixXd& rows, const ComponentChoice& choice);

}  // namespace gait
