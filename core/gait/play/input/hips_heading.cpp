#include "gait/play/input/hips_heading.h"

#include <algorithm>
#include <cmath>

#include "gait/model/body_pose.h"

namespace gait {

HipsHeading::HipsHeading(const Body& body, double frame_rate)
    : heading_(static_cast<int>(std::lround(body.heading_window * frame_rate))) {
  const JointRoles roles = body_roles(body);
  right_to_left_thigh_ = (body.skeleton.place_at_rest(roles.left.thigh, roles.hips) -
                          body.skeleton.place_at_rest(roles.right.thigh, roles.hips))
                             .cast<float>();
}

float HipsHeading::advance(const Eigen::Quaternionf& hips) noexcept {
  return heading_.advance(hips * right_to_left_thigh_);
}

int HipsHeading::input_of(const Body& body) {
  const int joint = body_roles(body).hips;
  const auto hips = std::find(body.input_joints.begin(), body.input_joints.end(), joint);
  return hips == body.input_joints.end() ? -1 : static_cast<int>(hips - body.input_joints.begin());
}

}  // namespace gait
