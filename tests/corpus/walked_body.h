// Where the joints and soles of a walk are, computed a second way: rotation matrices down the tree,
// without the library's forward kinematics.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <vector>

#include "gait/corpus/corpus.h"

namespace gait::testing {

// The built-in corpus at 30 fps, made once.
inline const std::vector<CorpusWalk>& corpus() {
  static const std::vector<CorpusWalk> walks = make_corpus(1);
  return walks;
}

struct WalkedBody {
  std::vector<Eigen::Matrix3d> turned;
  std::vector<Eigen::Vector3d> place;
};

inline WalkedBody walked_body(const Clip& clip, int frame) {
  WalkedBody body;
  for (int joint = 0; joint < clip.skeleton.size(); ++joint) {
    const auto j = static_cast<std::size_t>(joint);
    const int parent = clip.skeleton.joints[j].parent;
    const Eigen::Matrix3d local = clip.pose(frame)[j].toRotationMatrix();
    if (parent < 0) {
      body.turned.push_back(local);
      body.place.push_back(clip.translation(frame)[j]);
      continue;
    }
    const auto p = static_cast<std::size_t>(parent);
    body.place.push_back(body.place[p] + body.turned[p] * clip.skeleton.joints[j].offset);
    body.turned.push_back(body.turned[p] * local);
  }
  return body;
}

inline int foot_joint(const Clip& clip, Foot foot) {
  return clip.skeleton.find(foot == Foot::left ? "LeftFoot" : "RightFoot");
}

// Ball and heel of a foot.
inline std::array<Eigen::Vector3d, 2> sole(const Clip& clip, const WalkedBody& body, Foot foot) {
  const auto j = static_cast<std::size_t>(foot_joint(clip, foot));
  const auto& tips = clip.skeleton.joints[j].tips;
  return {body.place[j] + body.turned[j] * tips.at(0), body.place[j] + body.turned[j] * tips.at(1)};
}

inline double sole_height(const Clip& clip, const WalkedBody& body, Foot foot) {
  const auto ends = sole(clip, body, foot);
  return std::min(ends[0].y(), ends[1].y());
}

}  // namespace gait::testing
