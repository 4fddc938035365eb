// What the colours and marks of stick figures mean, under a film or film strip.
#pragma once

#include "draw/canvas.h"
#include "draw/walk_view.h"

namespace gait::tool {

// "left", "right", "foot touches" and the name of `compared` (may be null), on one line from x on,
// at most `room` wide (pixels). Names only what `view` shows.
void draw_legend(Canvas& canvas, const WalkView& view, const WalkView* compared, double x, double y,
                 double room);

}  // namespace gait::tool
