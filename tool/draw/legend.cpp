#include "draw/legend.h"

#include <algorithm>
#include <string>

namespace gait::tool {

void draw_legend(Canvas& canvas, const WalkView& view, const WalkView* compared, double x, double y,
                 double room) {
  constexpr double size = 18;  // of text, pixels
  const double end = x + room;
  const auto entry = [&](const std::string& word, Colour colour) {
    if (end - x < 80) return;
    canvas.line(x + 4, y - 6, x + 30, y - 6, 7, colour);
    x += 40 + canvas.text(x + 40, y, word, size, ink, Align::left, end - x - 40) + 32;
  };
  const auto has = [&](Side side) {
    return std::any_of(view.figure.bones.begin(), view.figure.bones.end(),
                       [&](const Bone& bone) { return bone.side == side; });
  };
  if (has(Side::left)) entry("left", left_colour);
  if (has(Side::right)) entry("right", right_colour);
  if (!view.footprints.empty() && end - x > 200) {
    canvas.mark(x + 10, y - 13, 12, left_colour);
    canvas.mark(x + 24, y - 13, 12, right_colour);
    x += 40 + canvas.text(x + 40, y, "foot touches", size, ink) + 32;
  }
  if (compared != nullptr) entry(compared->name, compared_colour);
}

}  // namespace gait::tool
