#include "gait/learn/standing_pose.h"

#include <cmath>
#include <utility>

#include "gait/model/body_pose.h"
#include "gait/motion/rotation.h"

namespace gait {

namespace {

using Pose = std::vector<Eigen::Quaterniond>;

// Phases from a leg's own contact: its foot carries the body alone and lies flat; later, before the
// heel rises, the knee is as straight as in standing.
constexpr double flat_from = 0.18, flat_until = 0.32;
constexpr double straight_from = 0.34, straight_until = 0.42;
// Offsets of a mirrored pair may differ by what measuring a person's bones leaves.
constexpr double uneven_share = 0.35, uneven_metres = 0.03;

std::vector<int> children_of(const Skeleton& skeleton, int joint) {
  std::vector<int> children;
  for (int child = joint + 1; child < skeleton.size(); ++child)
    if (skeleton.joints[child].parent == joint) children.push_back(child);
  return children;
}

// The axis (0, 1, 2) from right to left in the skeleton at rest.
int side_axis(const Skeleton& skeleton, const JointRoles& roles) {
  int axis = 0;
  (skeleton.place_at_rest(roles.left.foot) - skeleton.place_at_rest(roles.right.foot))
      .cwiseAbs()
      .maxCoeff(&axis);
  return axis;
}

void pair_below(const Skeleton& skeleton, int left, int right, std::vector<int>& partner) {
  partner[left] = right, partner[right] = left;
  const std::vector<int> of_left = children_of(skeleton, left);
  const std::vector<int> of_right = children_of(skeleton, right);
  if (of_left.size() != of_right.size()) return;
  for (std::size_t i = 0; i < of_left.size(); ++i)
    pair_below(skeleton, of_left[i], of_right[i], partner);
}

Eigen::Quaterniond mirrored(const Eigen::Quaterniond& rotation, int axis) {
  Eigen::Vector3d turned = -rotation.vec();
  turned[axis] = -turned[axis];
  return {rotation.w(), turned.x(), turned.y(), turned.z()};
}

Eigen::Quaterniond halfway(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return slerp(a, b, 0.5);
}

// Global rotation of a joint; joints above the hips are left out.
Eigen::Quaterniond in_world(const Skeleton& skeleton, const Pose& pose, int joint, int hips) {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  for (; joint >= 0; joint = skeleton.joints[joint].parent) {
    rotation = pose[joint] * rotation;
    if (joint == hips) break;
  }
  return rotation;
}

// Turns a thigh until the ankle is straight below it. In single stance the foot is below the middle
// of the body; both feet there would overlap.
void set_upright(const Skeleton& skeleton, const Leg& leg, int hips, Pose& pose) {
  Eigen::Vector3d to_ankle = Eigen::Vector3d::Zero();
  for (int joint = leg.foot; joint != leg.thigh; joint = skeleton.joints[joint].parent)
    to_ankle += in_world(skeleton, pose, skeleton.joints[joint].parent, hips) *
                skeleton.joints[joint].offset;
  const auto turn = turn_between(to_ankle, -Eigen::Vector3d::UnitY());
  const Eigen::Quaterniond above =
      in_world(skeleton, pose, skeleton.joints[leg.thigh].parent, hips);
  pose[leg.thigh] = above.conjugate() * turn * above * pose[leg.thigh];
}

class MeanCycle {
 public:
  MeanCycle(const Body& body, const std::vector<int>& joints, const Eigen::VectorXd& values)
      : body_(body), joints_(joints), values_(values) {
    frames_ = static_cast<int>(values.size() / (3 * static_cast<Eigen::Index>(joints.size())));
  }

  Pose pose(int frame) const {
    Pose pose = body_.references;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const auto at = 3 * (static_cast<std::size_t>(frame) * joints_.size() + i);
      pose[joints_[i]] = rotation_from<double>(std::span<const double, 3>(values_.data() + at, 3),
                                               body_.references[joints_[i]]);
    }
    return pose;
  }

  // Mean of `rotation_of(pose)` over phases [from, until).
  template <typename RotationOf>
  Eigen::Quaterniond mean(double from, double until, RotationOf rotation_of) const {
    Pose rotations;
    for (int k = static_cast<int>(from * frames_); k < until * frames_; ++k)
      rotations.push_back(rotation_of(pose(k % frames_)));
    return chordal_mean(rotations);
  }

 private:
  const Body& body_;
  const std::vector<int>& joints_;
  const Eigen::VectorXd& values_;
  int frames_;
};

// For each joint the one on the other side of the body, itself for those in the middle. Empty when
// the skeleton at rest is not the mirror image of itself.
std::vector<int> mirrored_joints(const Skeleton& skeleton, const JointRoles& roles) {
  if (!roles.has_legs()) return {};
  std::vector<int> partner(skeleton.joints.size());
  for (int joint = 0; joint < skeleton.size(); ++joint) partner[joint] = joint;
  const std::pair<Role, Role> sides[] = {{Role::left_thigh, Role::right_thigh},
                                         {Role::left_shoulder, Role::right_shoulder},
                                         {Role::left_arm, Role::right_arm}};
  for (const auto& [left_role, right_role] : sides) {
    int left = roles.joint(left_role), right = roles.joint(right_role);
    if (left < 0 || right < 0) continue;
    pair_below(skeleton, left, right, partner);
    // What lies between the trunk and the limb belongs to the limb.
    for (;;) {
      left = skeleton.joints[left].parent, right = skeleton.joints[right].parent;
      if (left < 0 || right < 0 || left == right) break;
      partner[left] = right, partner[right] = left;
    }
  }
  const int axis = side_axis(skeleton, roles);
  for (int joint = 0; joint < skeleton.size(); ++joint) {
    if (skeleton.joints[joint].parent < 0) continue;
    Eigen::Vector3d other = skeleton.joints[partner[joint]].offset;
    other[axis] = -other[axis];
    const Eigen::Vector3d& own = skeleton.joints[joint].offset;
    if ((own - other).norm() > uneven_share * own.norm() + uneven_metres) return {};
  }
  return partner;
}

}  // namespace

Eigen::VectorXd standing_pose(const Body& body, const std::vector<int>& joints,
                              const Eigen::VectorXd& cycle) {
  const JointRoles roles = body_roles(body);
  const Skeleton& skeleton = body.skeleton;
  const MeanCycle mean(body, joints, cycle);
  const std::vector<int> partner = mirrored_joints(skeleton, roles);
  const int axis = side_axis(skeleton, roles);

  Pose pose = body.references;
  for (const int joint : joints) {
    // Each leg from its own stance: right from phase 0, left from 0.5.
    const bool right = skeleton.is_in_branch(joint, roles.right.thigh);
    const bool left = skeleton.is_in_branch(joint, roles.left.thigh);
    const bool knee = joint == roles.right.shank || joint == roles.left.shank;
    const double contact = left ? 0.5 : 0.0;
    const double from = contact + (knee ? straight_from : left || right ? flat_from : 0.0);
    const double until = contact + (knee ? straight_until : left || right ? flat_until : 1.0);
    pose[joint] = mean.mean(from, until, [&](const Pose& at) { return at[joint]; });
  }
  const auto flat = [&](int foot, double contact) {
    return mean.mean(contact + flat_from, contact + flat_until,
                     [&](const Pose& at) { return in_world(skeleton, at, foot, roles.hips); });
  };
  Eigen::Quaterniond right_sole = flat(roles.right.foot, 0.0);
  Eigen::Quaterniond left_sole = flat(roles.left.foot, 0.5);
  if (!partner.empty()) {
    const Pose uneven = pose;
    for (const int joint : joints)
      pose[joint] = halfway(uneven[joint], mirrored(uneven[partner[joint]], axis));
    right_sole = halfway(right_sole, mirrored(left_sole, axis));
    left_sole = mirrored(right_sole, axis);
  }
  for (const auto& [leg, sole] : {std::pair{roles.right, right_sole}, {roles.left, left_sole}}) {
    set_upright(skeleton, leg, roles.hips, pose);
    pose[leg.foot] =
        in_world(skeleton, pose, skeleton.joints[leg.foot].parent, roles.hips).conjugate() * sole;
  }

  Eigen::VectorXd values(3 * static_cast<Eigen::Index>(joints.size()));
  pose_vector<double>(pose, body.references, joints,
                      {values.data(), static_cast<std::size_t>(values.size())});
  return values;
}

}  // namespace gait
