// Six poses that tell apart what forms do with bodies: left and right, each kind of joint, turned
// and moved; and what each form can carry of them.
#pragma once

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "gait/motion/humanoid.h"
#include "gait/motion/rotation.h"
#include "gait/osc/mocap_event.h"
#include "gait/osc/mvn_segments.h"

namespace gait::testing {

inline int osc_bone_of_segment(int segment) {
  const int bone = osc::mvn_bone(segment);
  return bone < 0 ? index_of(Bone::spine) : bone;  // L3
}

inline std::vector<int> bones_of(const HumanoidPose& pose) {
  std::vector<int> bones;
  for (int bone = 0; bone < humanoid_bones; ++bone)
    if (pose.turned[static_cast<std::size_t>(bone)]) bones.push_back(bone);
  return bones;
}

// A body of the usual lengths in the T-pose, in which these bones are turned against the one above
// (radians), facing `heading`, at `at`.
struct BoneTurn {
  Bone bone;
  Eigen::Quaterniond turn;
};
inline HumanoidPose posed(const std::vector<BoneTurn>& turns, double heading = 0,
                          const Eigen::Vector3d& at = {0, 0.93, 0}) {
  HumanoidPose pose;
  for (int bone = 0; bone < main_bones; ++bone) {
    const auto here = static_cast<std::size_t>(bone);
    const int above = bone_parent(bone);
    pose.turned.set(here);
    pose.placed.set(here);
    pose.turns[here] = above < 0 ? about_vertical(heading) : pose.turns[above];
    for (const BoneTurn& turn : turns)
      if (index_of(turn.bone) == bone) pose.turns[here] = pose.turns[here] * turn.turn;
    pose.places[here] =
        above < 0 ? at
                  : Eigen::Vector3d(pose.places[above] + pose.turns[above] * usual_offset(bone));
  }
  return pose;
}

inline Eigen::Quaterniond about(const Eigen::Vector3d& axis, double degrees) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()));
}

inline std::vector<HumanoidPose> six_poses() {
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {posed({{Bone::left_upper_arm, about(z, 60)}}),
          posed({{Bone::right_upper_arm, about(z, 70)}, {Bone::left_lower_arm, about(y, -80)}}),
          posed({{Bone::left_upper_leg, about(x, -50)},
                 {Bone::left_lower_leg, about(x, 70)},
                 {Bone::right_upper_leg, about(z, -15)}}),
          posed({{Bone::head, about(Eigen::Vector3d(0.3, 1, 0.2), 35)}}),
          posed({{Bone::left_upper_arm, about(z, -40)}}, 2.1),
          posed({{Bone::right_upper_leg, about(x, -30)}}, -0.7, {1.2, 0.88, -2.3})};
}

// Which parts a form leaves out: twists that are not observable, places that do not travel.
inline void expect_same_body(const HumanoidPose& sent, const HumanoidPose& got, osc::MocapForm form,
                             const std::string& what) {
  constexpr double limit = 0.1 * std::numbers::pi / 180;
  const bool places_only = form == osc::MocapForm::mediapipe;
  const bool trackers = form == osc::MocapForm::trackers;
  struct Limb {
    Bone bone;
    double x, y;
  };
  for (const auto& [bone, bx, by] :
       {Limb{Bone::left_upper_arm, 1, 0}, Limb{Bone::left_lower_arm, 1, 0},
        Limb{Bone::right_upper_arm, -1, 0}, Limb{Bone::right_lower_arm, -1, 0},
        Limb{Bone::left_upper_leg, 0, -1}, Limb{Bone::left_lower_leg, 0, -1},
        Limb{Bone::right_upper_leg, 0, -1}, Limb{Bone::right_lower_leg, 0, -1}}) {
    const Eigen::Vector3d along(bx, by, 0);
    ASSERT_TRUE(got.turned[index_of(bone)]) << what << " " << bone_name(index_of(bone));
    const Eigen::Vector3d was = sent.turns[index_of(bone)] * along,
                          is = got.turns[index_of(bone)] * along;
    EXPECT_LT(std::atan2(was.cross(is).norm(), was.dot(is)), limit)
        << what << " " << bone_name(index_of(bone));
  }
  std::vector<Bone> whole{Bone::hips, Bone::head};
  if (!places_only && !trackers)
    whole.insert(whole.end(), {Bone::spine, Bone::neck, Bone::left_upper_arm, Bone::right_hand,
                               Bone::left_foot, Bone::right_toes, Bone::left_upper_leg});
  if (form == osc::MocapForm::neuron) std::erase(whole, Bone::right_toes);  // has none
  if (trackers) whole.insert(whole.end(), {Bone::chest, Bone::left_foot, Bone::right_upper_leg});
  for (const Bone bone : whole) {
    ASSERT_TRUE(got.turned[index_of(bone)]) << what << " " << bone_name(index_of(bone));
    EXPECT_LT(angle_between(sent.turns[index_of(bone)], got.turns[index_of(bone)]), limit)
        << what << " " << bone_name(index_of(bone));
  }
  if (places_only) return;
  ASSERT_TRUE(got.placed[index_of(Bone::hips)]) << what;
  EXPECT_LT((sent.places[index_of(Bone::hips)] - got.places[index_of(Bone::hips)]).norm(), 1e-3)
      << what;
  ASSERT_TRUE(got.placed[index_of(Bone::head)]) << what;
  EXPECT_LT((sent.places[index_of(Bone::head)] - got.places[index_of(Bone::head)]).norm(), 2e-3)
      << what;
}

}  // namespace gait::testing
