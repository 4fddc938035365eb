// Standing pose, made from a walk when none was captured (G04 §3.1 captures one): the mean pose
// with each leg as in its own stance, both sides symmetric, and both soles flat.
#pragma once

#include <vector>

#include "gait/model/model.h"

namespace gait {

// `cycle`: a mean cycle's pose vectors, frame after frame, `joints` (ascending) of the body three
// values each, phase 0 at the right contact. Returns the pose vector of standing, three values per
// joint. Bodies that are not symmetric keep the mean pose.
Eigen::VectorXd standing_pose(const Body& body, const std::vector<int>& joints,
                              const Eigen::VectorXd& cycle);

}  // namespace gait
