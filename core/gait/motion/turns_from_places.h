// Turns from places: the pose of a body of which only the places of joints are known, as from a
// depth camera. Each bone of a limb is swung the shortest way from the direction that its parent
// gives it; the twist about its own axis is not observable.
#pragma once

#include "gait/motion/humanoid.h"

namespace gait {

// Sets `pose.turns` and `pose.turned` from the known ones of `pose.places`. Only directions count,
// not lengths. A bone whose places are missing gets no turn. Right-handed, Y up.
void turns_from_places(HumanoidPose& pose) noexcept;

}  // namespace gait
