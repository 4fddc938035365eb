// A page of film strips: one row of stick figures per clip, with the ground, where the feet first
// touch, and how far or how long.
#pragma once

#include <vector>

#include "draw/canvas.h"
#include "draw/strip_row.h"

namespace gait::tool {

// The page's layout in pixels, decided before there is a page.
struct FilmStripPage {
  struct Row {
    StripRow strip;
    double pixels_per_metre = 100;
    double x = 0, title_y = 0, ground_y = 0;
  };
  std::vector<Row> rows;
  int width = 0, height = 0;
  double legend_y = 0;
};

FilmStripPage lay_out_page(std::vector<StripRow> rows);

void draw_page(Canvas& canvas, const FilmStripPage& page);

// "left", "right" and what is grey, on one line from x on; only those of `view` that are known.
void draw_legend(Canvas& canvas, const WalkView& view, const WalkView* compared, double x, double y,
                 double room);

}  // namespace gait::tool
