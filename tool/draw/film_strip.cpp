#include "draw/film_strip.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "draw/canvas.h"
#include "draw/legend.h"
#include "draw/stick_figure.h"
#include "draw/strip_row.h"
#include "number_words.h"

namespace gait::tool {

namespace {

// Pixels.
constexpr double widest_page = 1800, narrowest_page = 760;
constexpr double margin = 36;
constexpr double title_size = 24, label_size = 18;
constexpr double title_room = 46;   // from a row's top to its figures' heads
constexpr double ground_room = 58;  // from the ground to the row's end: marks and labels
constexpr double row_gap = 26;
constexpr double legend_room = 44;
constexpr double mark_size = 12;

struct PageRow {
  StripRow strip;
  double pixels_per_metre = 100;
  double x = 0, title_y = 0, ground_y = 0;  // pixels
};

struct StripPage {
  std::vector<PageRow> rows;
  double width = 0, height = 0, legend_y = 0;  // pixels
};

// One scale for all, so that who is taller looks taller, unless they are not of a kind.
std::vector<double> scales(const std::vector<StripRow>& rows) {
  const double tallest = rows.size() == 1 ? 380 : rows.size() <= 4 ? 280 : 220;
  std::vector<double> own;
  double shared = 1e300, low = 1e300, high = 0;
  for (const StripRow& row : rows) {
    own.push_back(std::min(tallest / std::max(1e-9, row.height),
                           (widest_page - 2 * margin) / std::max(1e-9, row.width)));
    shared = std::min(shared, own.back());
    low = std::min(low, row.height);
    high = std::max(high, row.height);
  }
  if (high < 2 * low) std::fill(own.begin(), own.end(), shared);
  return own;
}

std::string facts(const StripRow& row) {
  const WalkView& view = *row.view;
  if (view.frames == 1) return "one frame";
  std::string words = in_words(view.seconds() < 10 ? "%.2f s" : "%.1f s", view.seconds());
  if (row.spread == Spread::by_travel && view.in_metres)
    words += ", " + in_words("%.2f m", std::abs(view.travel.back() - view.travel.front()) /
                                           view.foreshortening);
  if (row.figures.size() > 1)
    words += ", a figure every " +
             in_words("%.2f s", (row.figures.back().frame - row.figures.front().frame) /
                                    view.frame_rate / static_cast<double>(row.figures.size() - 1));
  return words;
}

// Under a mark at x, moved in where it would leave the page's margin.
void label(Canvas& canvas, double x, double y, const std::string& words) {
  const double half = canvas.text_width(words, label_size) / 2;
  canvas.text(std::clamp(x, margin + half, canvas.width() - margin - half), y, words, label_size,
              quiet_ink, Align::centre);
}

void draw_metres(Canvas& canvas, const PageRow& row, double y) {
  const StripRow& strip = row.strip;
  double every = 1;
  const double scale = row.pixels_per_metre * strip.view->foreshortening;
  while (every * scale < 70) every *= every == 2 ? 2.5 : 2;  // 1, 2, 5, 10
  const double direction = strip.view->travel[strip.figures.back().frame] <
                                   strip.view->travel[strip.figures.front().frame]
                               ? -1
                               : 1;
  for (int i = 0;; ++i) {
    const double metres =
        strip.figures.front().x + direction * i * every * strip.view->foreshortening;
    if (metres < 0 || metres > strip.width) break;
    const double x = row.x + metres * row.pixels_per_metre;
    canvas.line(x, row.ground_y, x, row.ground_y + 7, 1.5, quiet_ink);
    label(canvas, x, y, in_words("%.0f m", i * every));
  }
}

void draw_moments(Canvas& canvas, const PageRow& row, double y) {
  const StripRow& strip = row.strip;
  if (strip.figures.size() < 2) return;
  const double spacing = (strip.figures[1].x - strip.figures[0].x) * row.pixels_per_metre;
  const int every = std::max(1, static_cast<int>(std::ceil(74 / std::max(1.0, spacing))));
  for (std::size_t i = 0; i < strip.figures.size(); i += every)
    label(canvas, row.x + strip.figures[i].x * row.pixels_per_metre, y,
          in_words("%.2f s", strip.figures[i].frame / strip.view->frame_rate));
}

void draw_footprints(Canvas& canvas, const PageRow& row) {
  const StripRow& strip = row.strip;
  if (strip.figures.size() < 2) return;
  for (const Footprint& footprint : strip.view->footprints) {
    if (footprint.frame < strip.figures.front().frame ||
        footprint.frame > strip.figures.back().frame)
      continue;
    const double metres = strip.spread == Spread::by_travel ? strip.x_of_travel(footprint.right)
                                                            : strip.x_of_frame(footprint.frame);
    canvas.mark(row.x + metres * row.pixels_per_metre, row.ground_y + 5, mark_size,
                footprint.foot == Foot::left ? left_colour : right_colour);
  }
}

void draw_row(Canvas& canvas, const PageRow& row) {
  const StripRow& strip = row.strip;
  const double right = canvas.width() - margin;
  const std::string words = facts(strip);
  const double words_width = canvas.text_width(words, label_size);
  canvas.text(margin, row.title_y, strip.view->name, title_size, ink, Align::left,
              right - margin - words_width - 30);
  canvas.text(right, row.title_y, words, label_size, quiet_ink, Align::right);

  canvas.line(margin, row.ground_y, right, row.ground_y, 1.5, quiet_ink);
  const auto place = [&](const ShownFigure& figure) {
    return Placement{row.x + figure.x * row.pixels_per_metre, row.ground_y, row.pixels_per_metre};
  };
  if (strip.compared != nullptr)
    for (const ShownFigure& figure : strip.figures)
      if (const int frame = strip.compared_frame(figure.frame); frame >= 0)
        draw_figure(canvas, *strip.compared, frame, place(figure), Tone::compared);
  for (const ShownFigure& figure : strip.figures)
    draw_figure(canvas, *strip.view, figure.frame, place(figure), Tone::coloured);

  draw_footprints(canvas, row);
  const double labels_y = row.ground_y + 5 + mark_size + 6 + label_size;
  if (strip.spread == Spread::by_time)
    draw_moments(canvas, row, labels_y);
  else if (strip.view->in_metres)
    draw_metres(canvas, row, labels_y);
}

StripPage lay_out_page(std::vector<StripRow> rows) {
  StripPage page;
  const std::vector<double> scale = scales(rows);
  double width = narrowest_page;
  for (std::size_t i = 0; i < rows.size(); ++i)
    width = std::max(width, rows[i].width * scale[i] + 2 * margin);
  double y = margin;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    PageRow row;
    row.pixels_per_metre = scale[i];
    row.x = rows.size() == 1 || rows[i].figures.size() == 1 ? (width - rows[i].width * scale[i]) / 2
                                                            : margin;
    row.title_y = y + title_size;
    row.ground_y = y + title_room + rows[i].height * scale[i];
    y = row.ground_y + std::max(ground_room, rows[i].depth * scale[i]) + row_gap;
    row.strip = std::move(rows[i]);
    page.rows.push_back(std::move(row));
  }
  page.width = width;
  page.legend_y = y;
  page.height = y + legend_room;
  return page;
}

void draw_page(Canvas& canvas, const StripPage& page) {
  for (const PageRow& row : page.rows) draw_row(canvas, row);
  // The legend speaks for the row that has most to say.
  const auto rich =
      std::max_element(page.rows.begin(), page.rows.end(), [](const auto& a, const auto& b) {
        const auto says = [](const PageRow& row) {
          return 2 * static_cast<int>(row.strip.view->in_metres) +
                 static_cast<int>(!row.strip.view->footprints.empty());
        };
        return says(a) < says(b);
      });
  draw_legend(canvas, *rich->strip.view, rich->strip.compared, margin, page.legend_y,
              page.width - 2 * margin);
}

}  // namespace

void write_film_strip(const std::vector<WalkView>& views, const WalkView* compared, int strobe,
                      const std::filesystem::path& path) {
  std::vector<StripRow> rows;
  for (const WalkView& view : views) rows.push_back(lay_out_row(view, compared, strobe));
  const StripPage page = lay_out_page(std::move(rows));
  write_picture(path, page.width, page.height, [&](Canvas& canvas) { draw_page(canvas, page); });
}

}  // namespace gait::tool
