#include "draw/stick_figure.h"

#include <algorithm>
#include <array>

namespace gait::tool {

namespace {

Colour colour_of(Side side, Tone tone) {
  if (tone == Tone::compared) return compared_colour;
  if (side == Side::left) return left_colour;
  if (side == Side::right) return right_colour;
  return middle_colour;
}

// Mean nearness of a side's bones to the viewer (metres).
double nearness(const WalkView& view, int frame, Side side) {
  double sum = 0;
  int count = 0;
  for (const Bone& bone : view.figure.bones)
    if (bone.side == side) {
      sum += view.point(frame, bone.from).z() + view.point(frame, bone.to).z();
      count += 2;
    }
  return count == 0 ? 0 : sum / count;
}

// Pixels: how thick a limb is, and the rim of paper that shows which limb passes in front.
double thickness(const WalkView& view, double scale, Tone tone) {
  return std::max(1.2, 0.024 * view.height * scale) * (tone == Tone::compared ? 1.3 : 1.0);
}
double rim(double thick) { return std::clamp(0.35 * thick, 0.8, 3.0); }

// Where a point lands on the page.
Spot spot(const WalkView& view, int frame, int point, const Placement& place) {
  // Feet are lines with a thickness: they stand on the ground, not in it.
  const double thick = thickness(view, place.pixels_per_metre, Tone::coloured);
  const double lift = thick / 2 + rim(thick);
  return {place.x + place.pixels_per_metre * view.point(frame, point).x(),
          place.ground_y - lift - place.pixels_per_metre * view.point(frame, point).y()};
}

void draw_side(Canvas& canvas, const WalkView& view, int frame, const Placement& place, Tone tone,
               Side side) {
  const double thick = thickness(view, place.pixels_per_metre, tone);
  // The rim ends square, so that it does not cut into what the limb hangs on.
  const auto stroke = [&](double more, Colour colour, Ends ends) {
    for (const Bone& bone : view.figure.bones) {
      if (bone.side != side) continue;
      const Spot from = spot(view, frame, bone.from, place), to = spot(view, frame, bone.to, place);
      canvas.line(from.x, from.y, to.x, to.y,
                  (bone.fine ? std::max(0.8, 0.3 * thick) : thick) + more, colour, ends);
    }
    const int head = view.figure.head_centre;
    if (side != Side::middle || head < 0) return;
    const Spot centre = spot(view, frame, head, place);
    canvas.disc(centre.x, centre.y, view.figure.head_radius * place.pixels_per_metre + more / 2,
                colour);
  };
  if (tone == Tone::coloured) stroke(2 * rim(thick), paper, Ends::cut);
  stroke(0, colour_of(side, tone), Ends::round);
}

}  // namespace

void draw_figure(Canvas& canvas, const WalkView& view, int frame, const Placement& place,
                 Tone tone) {
  if (view.figure.bones.empty()) {
    const Spot only = spot(view, frame, 0, place);
    canvas.disc(only.x, only.y, 5, colour_of(Side::middle, tone));
    return;
  }
  const bool left_is_near = nearness(view, frame, Side::left) > nearness(view, frame, Side::right);
  const std::array<Side, 3> far_to_near = {left_is_near ? Side::right : Side::left, Side::middle,
                                           left_is_near ? Side::left : Side::right};
  for (const Side side : far_to_near) draw_side(canvas, view, frame, place, tone, side);
}

}  // namespace gait::tool
