// The segments of Xsens MVN, by their numbers in the pose data of types 01 and 02 (from Xsens'
// protocol specification): 23 of the body, then at most 4 props, then 20 of the left hand and 20 of
// the right.
#pragma once

#include <array>

#include "gait/motion/humanoid.h"

namespace gait::osc {

inline constexpr int mvn_segments = 23, mvn_hand = 20;

// A humanoid's bone of a body's segment, from 0; -1: the segment lies between bones.
inline int mvn_bone(int segment) {
  constexpr std::array<Bone, mvn_segments> bones{Bone::hips,
                                                 Bone::spine,
                                                 Bone::jaw /* L3 */,
                                                 Bone::chest,
                                                 Bone::upper_chest,
                                                 Bone::neck,
                                                 Bone::head,
                                                 Bone::right_shoulder,
                                                 Bone::right_upper_arm,
                                                 Bone::right_lower_arm,
                                                 Bone::right_hand,
                                                 Bone::left_shoulder,
                                                 Bone::left_upper_arm,
                                                 Bone::left_lower_arm,
                                                 Bone::left_hand,
                                                 Bone::right_upper_leg,
                                                 Bone::right_lower_leg,
                                                 Bone::right_foot,
                                                 Bone::right_toes,
                                                 Bone::left_upper_leg,
                                                 Bone::left_lower_leg,
                                                 Bone::left_foot,
                                                 Bone::left_toes};
  const Bone bone = bones[static_cast<std::size_t>(segment)];
  return bone == Bone::jaw ? -1 : index_of(bone);
}
inline int mvn_parent(int segment) {
  constexpr std::array<int, mvn_segments> parents{-1, 0,  1,  2, 3,  4,  5,  4, 7,  8,  9, 4,
                                                  11, 12, 13, 0, 15, 16, 17, 0, 19, 20, 21};
  return parents[static_cast<std::size_t>(segment)];
}
// Of a hand: the carpus, three of the thumb, then four for each finger, the first within the hand.
inline int mvn_finger_bone(int segment, Bone fingers) {
  if (segment == 0) return -1;
  if (segment < 4) return index_of(fingers) + segment - 1;
  const int finger = (segment - 4) / 4 + 1, piece = (segment - 4) % 4;
  return piece == 0 ? -1 : index_of(fingers) + 3 * finger + piece - 1;
}

}  // namespace gait::osc
