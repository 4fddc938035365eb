#include "gait/motion/rest_calibration.h"

#include <Eigen/SVD>

#include "gait/motion/rotation.h"

namespace gait {

namespace {

constexpr double shortest_bone = 0.01;  // metres; shorter ones have no direction to speak of

// Directions in which a joint's bones leave it, in its own frame: to children that both rigs have,
// and to end sites.
struct BonePair {
  Eigen::Vector3d from, to;
};

std::vector<BonePair> bones_of(const Skeleton& from, const Skeleton& to, int joint, int match) {
  std::vector<BonePair> bones;
  const auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    if (a.norm() >= shortest_bone && b.norm() >= shortest_bone)
      bones.push_back({a.normalized(), b.normalized()});
  };
  for (const Joint& child : from.joints) {
    if (child.parent != joint) continue;
    const int other = to.find(child.name);
    if (other >= 0 && to.joints[other].parent == match) add(child.offset, to.joints[other].offset);
  }
  const auto &tips = from.joints[joint].tips, &other_tips = to.joints[match].tips;
  if (tips.size() == other_tips.size())
    for (std::size_t i = 0; i < tips.size(); ++i) add(tips[i], other_tips[i]);
  return bones;
}

Eigen::Quaterniond turn_of(const std::vector<BonePair>& bones) {
  if (bones.empty()) return Eigen::Quaterniond::Identity();
  if (bones.size() == 1) return turn_between(bones[0].to, bones[0].from);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const BonePair& bone : bones) sum += bone.from * bone.to.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // For bones in one plane or line the best orthogonal matrix may be a reflection: make it a
  // rotation.
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return Eigen::Quaterniond(Eigen::Matrix3d(svd.matrixU() * sign * svd.matrixV().transpose()));
}

}  // namespace

std::vector<Eigen::Quaterniond> rest_turns(const Skeleton& from, const Skeleton& to) {
  std::vector<Eigen::Quaterniond> turns(from.joints.size(), Eigen::Quaterniond::Identity());
  for (int joint = 0; joint < from.size(); ++joint) {
    const int match = to.find(from.joints[joint].name);
    if (match >= 0) turns[joint] = turn_of(bones_of(from, to, joint, match));
  }
  return turns;
}

Clip with_rest_turned(const Clip& clip, std::span<const Eigen::Quaterniond> turns) {
  Clip turned = clip;
  for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
    const int parent = clip.skeleton.joints[joint].parent;
    const Eigen::Quaterniond above =
        parent < 0 ? Eigen::Quaterniond::Identity() : turns[parent].conjugate();
    Joint& mine = turned.skeleton.joints[joint];
    mine.offset = above * mine.offset;
    for (Eigen::Vector3d& tip : mine.tips) tip = turns[joint].conjugate() * tip;
    for (int frame = 0; frame < clip.frames(); ++frame) {
      turned.pose(frame)[joint] = above * clip.pose(frame)[joint] * turns[joint];
      turned.translation(frame)[joint] = above * clip.translation(frame)[joint];
    }
  }
  return turned;
}

Clip calibrated(const Clip& clip, const Skeleton& to) {
  return with_rest_turned(clip, rest_turns(clip.skeleton, to));
}

Eigen::Quaterniond rest_turned_back(const Eigen::Quaterniond& rotation,
                                    const Eigen::Quaterniond& turn,
                                    const Eigen::Quaterniond& parent_turn) {
  return parent_turn * rotation * turn.conjugate();
}

}  // namespace gait
