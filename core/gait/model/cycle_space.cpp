#include "gait/model/cycle_space.h"

namespace gait {

int CycleSpace::components_for(double share) const {
  const double total = variances.sum();
  double sum = 0;
  for (Eigen::Index i = 0; i < variances.size(); ++i) {
    sum += variances[i];
    if (sum >= share * total) return static_cast<int>(i) + 1;
  }
  return static_cast<int>(variances.size());
}

}  // namespace gait
