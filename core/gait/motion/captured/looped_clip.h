// Loops: clips made to be played again and again, whose last pose is their first. One pass shows
// few steps; several in a row are a walk of whole cycles.
#pragma once

#include "gait/motion/clip.h"

namespace gait {

// Whether the last frame holds the first one's pose, but for where the root is along the ground,
// and others do not.
bool loops(const Clip& clip);

// `passes` passes through a loop, each beginning where the one before ended; the last pose of one
// is the first of the next. Y up.
Clip unrolled(const Clip& clip, int passes);

}  // namespace gait
