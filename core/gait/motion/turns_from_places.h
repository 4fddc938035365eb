// Turns from places: a body's pose where only the places of its joints are seen, as by a depth
// camera. A limb is swung the shortest way from where its trunk or upper limb carries it; how it is
// twisted about itself cannot be seen.
#pragma once

#include "gait/motion/humanoid.h"

namespace gait {

// Fills `pose.turns` and `pose.turned` from `pose.places`, as far as these are known. Lengths do
// not count, only directions. A bone whose places are missing is not turned. Right-handed, Y up.
void turns_from_places(HumanoidPose& pose) noexcept;

}  // namespace gait
