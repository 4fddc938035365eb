// Which lines make a stick figure of a skeleton: any skeleton, with or without known roles.
//
// Points are the joints, then the tips (end sites), then the middle of the head when there is one.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "gait/motion/joint_roles.h"
#include "gait/motion/skeleton.h"

namespace gait::tool {

enum class Side { middle, left, right };

struct Bone {
  int from = 0, to = 0;  // points
  Side side = Side::middle;
  bool fine = false;  // fingers, faces: drawn thin
};

// A point that hangs on a joint.
struct Point {
  int joint = 0;
  Eigen::Vector3d offset{0, 0, 0};  // in the joint's frame
};

struct StickBones {
  std::vector<Point> points;
  std::vector<Bone> bones;
  std::vector<bool> drawn;  // per point: does a bone or the head's disc show it?
  int head_centre = -1;     // point, -1: no head is known
  double head_radius = 0;   // the skeleton's unit
};

// `body`: from the head to what lies farthest from it, in the skeleton's unit; sizes the head.
StickBones stick_bones(const Skeleton& skeleton, const JointRoles& roles, double body);

}  // namespace gait::tool
