// Standing, made from a walk where none was captured (G04 §3.1 has a captured one): the mean pose,
// each leg as it is while it alone carries the body, both sides alike, both soles flat.
#pragma once

#include <vector>

#include "gait/model/model.h"

namespace gait {

// For each joint the one on the other side of the body, itself for those in the middle. Empty when
// the skeleton at rest is not the mirror image of itself.
std::vector<int> mirrored_joints(const Skeleton& skeleton, const JointRoles& roles);

// `cycle`: a mean cycle's pose vectors, frame after frame, `joints` (ascending) of the body three
// values each, phase 0 at the right contact. Returns the pose vector of standing, three values per
// joint. Bodies that are not mirror images of themselves stay as the mean has them.
Eigen::VectorXd standing_pose(const Body& body, const std::vector<int>& joints,
                              const Eigen::VectorXd& cycle);

}  // namespace gait
