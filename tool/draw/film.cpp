#include "draw/film.h"

#include <algorithm>
#include <cmath>

#include "draw/canvas.h"
#include "draw/ffmpeg.h"
#include "draw/legend.h"
#include "draw/stick_figure.h"
#include "gait/platform/whole_file.h"
#include "number_words.h"

namespace gait::tool {

namespace {

constexpr int most_columns = 4;
constexpr double fastest = 60;  // frames per second: what players and screens take
constexpr double margin = 20, title_size = 22, label_size = 16;
constexpr double title_room = 44, ground_room = 44, legend_room = 40;

// Where one walker is filmed.
struct Cell {
  double x = 0, y = 0, width = 0, height = 0;  // pixels
  double pixels_per_metre = 100;
  double centre = 0;  // metres right of the walker's own place that stay in the middle
};

// Widens `all` to what the view shows in any frame, about the walker's own place.
void include_all(const WalkView& view, Extent& all) {
  for (int frame = 0; frame < view.frames; ++frame) all.include(view, frame, 0.02 * view.height);
}

Cell fit(const WalkView& view, const WalkView* compared, double x, double y, double width,
         double height) {
  Extent all{0, 0, 0, 0};
  include_all(view, all);
  if (compared != nullptr) include_all(*compared, all);
  Cell cell{x, y, width, height, 1, (all.left + all.right) / 2};
  cell.pixels_per_metre =
      std::min((width - 2 * margin) / std::max(1e-9, all.right - all.left),
               (height - title_room - ground_room) / std::max(1e-9, all.high - all.low));
  return cell;
}

int frame_at(const WalkView& view, double seconds) {
  return static_cast<int>(std::lround(seconds * view.frame_rate));
}

// Marks every half metre, and where the feet touch, pass by under the walker.
void draw_ground(Canvas& canvas, const WalkView& view, const Cell& cell, double travel,
                 double ground_y) {
  const double half = (cell.width - 2 * margin) / 2;
  const double middle = cell.x + cell.width / 2;
  canvas.line(middle - half, ground_y, middle + half, ground_y, 1.5, quiet_ink);
  if (view.foreshortening < 0.05) return;  // the way comes towards the camera
  const double every = (view.in_metres ? 0.5 : 0.3 * view.height) * view.foreshortening;
  const double seen = half / cell.pixels_per_metre;
  const double at = travel + cell.centre;  // the place along the walk that is in the middle
  for (double tick = std::ceil((at - seen) / every); tick * every <= at + seen; ++tick) {
    const double x = middle + (tick * every - at) * cell.pixels_per_metre;
    canvas.line(x, ground_y, x, ground_y + 8, 1.5, quiet_ink);
  }
  for (const Footprint& footprint : view.footprints) {
    const double x = middle + (footprint.right - at) * cell.pixels_per_metre;
    if (std::abs(x - middle) < half)
      canvas.mark(x, ground_y + 10, 12, footprint.foot == Foot::left ? left_colour : right_colour);
  }
}

void draw_cell(Canvas& canvas, const WalkView& view, const WalkView* compared, const Cell& cell,
               double seconds) {
  const int frame = std::min(frame_at(view, seconds), view.frames - 1);
  const double ground_y = cell.y + cell.height - ground_room;
  draw_ground(canvas, view, cell, view.travel[frame], ground_y);
  const Placement place{cell.x + cell.width / 2 - cell.centre * cell.pixels_per_metre, ground_y,
                        cell.pixels_per_metre};
  if (compared != nullptr && frame_at(*compared, seconds) < compared->frames)
    draw_figure(canvas, *compared, frame_at(*compared, seconds), place, Tone::compared);
  draw_figure(canvas, view, frame, place, Tone::coloured);
  canvas.text(cell.x + margin, cell.y + title_size + 10, view.name, title_size, ink, Align::left,
              cell.width - 2 * margin);
}

}  // namespace

void write_film(const std::vector<WalkView>& views, const WalkView* compared,
                const std::filesystem::path& path, const std::function<void(double)>& progress) {
  const int columns = std::min<int>(most_columns, static_cast<int>(views.size()));
  const int rows = (static_cast<int>(views.size()) + columns - 1) / columns;
  const int cell_width = columns == 1 ? 800 : columns == 2 ? 640 : 400;
  const int cell_height = columns == 1 ? 640 : 480;
  const int width = columns * cell_width;
  const int height = rows * cell_height + static_cast<int>(legend_room);

  std::vector<Cell> cells;
  double seconds = 0, rate = 1;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
    cells.push_back(
        fit(views[i], compared, column * cell_width, row * cell_height, cell_width, cell_height));
    seconds = std::max(seconds, views[i].seconds());
    rate = std::max(rate, views[i].frame_rate);
  }
  // 120 a second become every second frame, not 60 uneven ones.
  if (rate > fastest) rate /= std::ceil(rate / fastest - 1e-3);

  WholeFile output(path);
  Canvas canvas = Canvas::of_pixels(width, height);
  Ffmpeg ffmpeg(output.part(), width, height, rate);
  const int frames = 1 + static_cast<int>(std::lround(seconds * rate));
  for (int frame = 0; frame < frames; ++frame) {
    canvas.clear();
    for (std::size_t i = 0; i < views.size(); ++i)
      draw_cell(canvas, views[i], compared, cells[i], frame / rate);
    canvas.text(width - margin, height - 14, in_words("%.2f s", frame / rate), label_size,
                quiet_ink, Align::right);
    draw_legend(canvas, views.front(), compared, margin, height - 14, width - 2 * margin - 90);
    ffmpeg.add(canvas.pixels());
    progress((frame + 1.0) / frames);
  }
  ffmpeg.finish();
  output.keep();
}

}  // namespace gait::tool
