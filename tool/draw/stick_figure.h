// One stick figure on a page: far limbs behind near ones, left and right in their colours.
#pragma once

#include "draw/canvas.h"
#include "draw/walk_view.h"

namespace gait::tool {

// Where metres of a walk's view land on the page.
struct Placement {
  double x = 0, ground_y = 0;  // pixels: the walker's own place, the ground
  double pixels_per_metre = 100;
};

enum class Tone { coloured, compared };  // in colours, or in grey behind another figure

void draw_figure(Canvas& canvas, const WalkView& view, int frame, const Placement& place,
                 Tone tone);

}  // namespace gait::tool
