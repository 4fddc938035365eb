// Skeleton: a tree of joints, each at a fixed offset from its parent.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace gait {

struct Joint {
  std::string name;
  int parent = -1;  // index of the parent, always smaller than the joint's own; -1: a root
  Eigen::Vector3d offset{0, 0, 0};      // from the parent, in the parent's frame
  std::vector<Eigen::Vector3d> tips{};  // end sites: where bones without a joint at their end stop
  // In a rig re-rooted at its hips: the file's joint at whose place this one sits, where that is
  // another (motion/body_form.h). It tells the role.
  std::string sits_at{};
};

struct Skeleton {
  std::vector<Joint> joints;  // parents before children, in the order of the file

  int size() const { return static_cast<int>(joints.size()); }

  // Index of the joint with this very name, -1 when there is none.
  int find(std::string_view name) const;

  // Whether a joint is `ancestor` or anywhere below it; -1 is nowhere.
  bool is_in_branch(int joint, int ancestor) const {
    while (joint >= 0 && joint != ancestor) joint = joints[static_cast<std::size_t>(joint)].parent;
    return joint >= 0 && joint == ancestor;
  }

  // Place of a joint at rest (all rotations identity) from an ancestor, by default from the origin:
  // the sum of the offsets on the way.
  Eigen::Vector3d place_at_rest(int joint, int ancestor = -1) const {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (; joint >= 0 && joint != ancestor; joint = joints[static_cast<std::size_t>(joint)].parent)
      place += joints[static_cast<std::size_t>(joint)].offset;
    return place;
  }
};

}  // namespace gait
