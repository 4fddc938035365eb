// Rest rows: frames at a clip's ends that hold the rig's rest pose (or any pose held still) and are
// parted from the motion by a jump. Many exporters write one such row first; some hold it for
// seconds, at the origin, metres from the walk. They are no part of the motion.
#pragma once

#include <optional>
#include <string>

#include "gait/motion/clip.h"

namespace gait {

struct MovingRows {
  int begin = 0, end = 0;  // frames [begin, end) move

  bool are_all_of(const Clip& clip) const { return begin == 0 && end == clip.frames(); }
};

// Finds them by the jump: a change from frame to frame, over all joints and the root's place, far
// above those of the motion, with hardly any change between it and the clip's end. In any unit.
MovingRows moving_rows(const Clip& clip);

// These frames alone.
Clip rows_of(const Clip& clip, const MovingRows& rows);

// What was left out, for a warning; none when nothing was. Frames are counted from 0.
std::optional<std::string> rest_rows_told(const Clip& clip, const MovingRows& rows);

}  // namespace gait
