// Resampling: a clip at another frame rate.
//
// Rotations are interpolated by SLERP (Shoemake 1985), translations linearly. The first frame keeps
// its time; the clip gets shorter by less than one new frame.
#pragma once

#include "gait/motion/clip.h"

namespace gait {

// The clip at `frame_rate` frames per second. Where the new rate is the old one, a whole fraction
// or a whole multiple of it, frames that fall on an old frame are that frame to the bit: 30 from
// 120 picks every fourth. Rates are compared with a tolerance of 1e-4, because files round their
// frame time (0.0083333 s is meant as 120 fps). Throws Error when a rate is not a positive number.
Clip resampled(const Clip& clip, double frame_rate);

}  // namespace gait
