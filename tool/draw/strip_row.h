// One row of a film strip: which frames of a clip are shown, and where each figure stands.
//
// A clip that walks shows its figures where they were, evenly in time, as a stroboscope does. One
// that stays on the spot (or hardly travels, or travels too far for a legible picture) shows them
// side by side.
#pragma once

#include <string>
#include <vector>

#include "draw/walk_view.h"

namespace gait::tool {

enum class Spread { by_travel, by_time };

struct ShownFigure {
  int frame = 0;
  double x = 0;  // metres from the row's left edge to the walker's own place
};

struct StripRow {
  const WalkView* view = nullptr;
  const WalkView* compared = nullptr;  // drawn in grey behind the same moments; may be null
  Spread spread = Spread::by_time;
  std::vector<ShownFigure> figures;
  double width = 0, height = 0;  // metres that hold every figure, from the ground up
  double depth = 0;              // metres below the ground that figures reach

  // Frame of `compared` at the moment of `frame`; -1 when it has ended by then.
  int compared_frame(int frame) const;
  // Metres from the row's left edge for a place along the walk, or for a moment.
  double x_of_travel(double travel) const;
  double x_of_frame(double frame) const;
};

// `strobe`: number of figures, 0: chosen, about twelve. `view` and `compared` must outlive the row.
StripRow lay_out_row(const WalkView& view, const WalkView* compared, int strobe);

}  // namespace gait::tool
