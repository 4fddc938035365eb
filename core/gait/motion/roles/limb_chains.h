// Limbs of a tree whose names say nothing: two chains of like length that leave one joint. Private
// to finding roles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "gait/motion/clip.h"

namespace gait {

// Places of all joints in some poses of a rig, any unit and axes; and the longest way down from
// each joint.
class RigPoses {
 public:
  // From frames spread over the clip; from the rest pose when it has none.
  explicit RigPoses(const Clip& clip);

  const Skeleton& skeleton() const { return *skeleton_; }
  int poses() const { return static_cast<int>(places_.size()); }
  const Eigen::Vector3d& place(int pose, int joint) const { return places_[pose][joint]; }
  // Where the joint's longest end site is; nothing when it has none.
  std::optional<Eigen::Vector3d> tip(int pose, int joint) const;
  // Mean distance of two joints.
  double distance(int a, int b) const;
  double bone(int joint) const;  // its distance from its parent
  // From the joint to the farthest end below it, along the bones.
  double reach(int joint) const { return reach_[joint]; }
  const std::vector<int>& children(int joint) const { return children_[joint]; }
  // From a joint down along the longest chain.
  std::vector<int> chain(int joint) const;

 private:
  const Skeleton* skeleton_;
  std::vector<std::vector<Eigen::Vector3d>> places_, tips_;
  std::vector<std::vector<int>> children_;
  std::vector<double> reach_;
};

struct LimbPair {
  int parent = -1;                         // both hang on it
  std::array<std::vector<int>, 2> chains;  // joints from the parent's child down
};

// The two legs: the longest pair of chains that leaves the rest of the body behind.
std::optional<LimbPair> find_leg_chains(const RigPoses& rig);
// The two arms: the longest pair of other chains. `taken`: one per joint, those of the legs.
std::optional<LimbPair> find_arm_chains(const RigPoses& rig, const std::vector<bool>& taken);

// Joints at both ends and in the middle of a limb, -1 where there is none. For legs thigh, shank,
// foot and toes; for arms collar bone, upper arm, forearm, hand.
using LimbJoints = std::array<int, 4>;
std::array<LimbJoints, 2> joints_of_legs(const RigPoses& rig, const LimbPair& legs);
LimbJoints joints_of_arm(const RigPoses& rig, const std::vector<int>& chain);

// Above zero when the first of two legs is the left one, from where feet and knees point.
double first_is_left(const RigPoses& rig, const std::array<LimbJoints, 2>& legs);

}  // namespace gait
