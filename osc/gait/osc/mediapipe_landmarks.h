// MediaPipe's 33 landmarks of a body, and the body that they make. A camera's world landmarks:
// metres, the middle between the hips as origin, x to the right of the picture, y down, z away from
// it.
#pragma once

#include <array>
#include <string_view>

#include "gait/motion/humanoid.h"

namespace gait::osc {

inline constexpr int mediapipe_landmarks = 33;

struct Landmarks {
  std::array<Eigen::Vector3d, mediapipe_landmarks> places;  // as the camera tells them
  std::bitset<mediapipe_landmarks> seen;
};

// By its usual name, however it is written ("left_shoulder", "leftShoulder"); -1: none.
int landmark_named(std::string_view name);

// Turns and places of the bones whose landmarks are seen. The twist of upper arms, thighs and shins
// about themselves is not observable.
void body_of(const Landmarks& landmarks, HumanoidPose& pose) noexcept;
// Where the landmarks of a body are.
void landmarks_of(const HumanoidPose& pose, Landmarks& landmarks) noexcept;

}  // namespace gait::osc
