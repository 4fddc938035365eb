#include "gait/play/input/hips_heading.h"

#include <algorithm>
#include <cmath>

#include "gait/model/body_pose.h"

namespace gait {

namespace {

// From `above` to `joint`, over whatever joints a rig has between hips and thigh.
Eigen::Vector3d place_at_rest(const Skeleton& skeleton, int joint, int above) {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (; joint >= 0 && joint != above; joint = skeleton.joints[joint].parent)
    place += skeleton.joints[joint].offset;
  return place;
}

}  // namespace

HipsHeading::HipsHeading(const Body& body, double frame_rate)
    : heading_(static_cast<int>(std::lround(body.heading_window * frame_rate))) {
  const JointRoles roles = body_roles(body);
  right_to_left_thigh_ = (place_at_rest(body.skeleton, roles.left.thigh, roles.hips) -
                          place_at_rest(body.skeleton, roles.right.thigh, roles.hips))
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
