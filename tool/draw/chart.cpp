#include "draw/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <sstream>

namespace gait::tool {

namespace {

// Pixels.
constexpr double margin = 30;
constexpr double title_size = 24, label_size = 19, tick_size = 17, note_size = 15;
constexpr double tick_length = 6;
constexpr double left_room = 74;    // ticks' numbers
constexpr double top_room = 40;     // the y axis' label
constexpr double bottom_room = 62;  // ticks' numbers and the x axis' label
constexpr double gap = 34;          // between panels
constexpr double legend_line = 30, legend_mark = 44, note_line = 22;
constexpr double marker_radius = 4.5;

// Okabe and Ito's set without yellow, which paper swallows.
constexpr std::array<Colour, 6> colours{{{0.00, 0.45, 0.70},
                                         {0.84, 0.37, 0.00},
                                         {0.00, 0.62, 0.45},
                                         {0.80, 0.47, 0.65},
                                         {0.34, 0.71, 0.91},
                                         {0.90, 0.62, 0.00}}};
constexpr Colour grid{0.88, 0.88, 0.89};

std::vector<double> dashes_of(Stroke stroke) {
  if (stroke == Stroke::dashed) return {10, 6};
  if (stroke == Stroke::dotted) return {3, 4};
  return {};
}

// 1, 2 or 5 times a power of ten, so that there are about `wanted` ticks, and three at least.
double tick_step(const Axis& axis, double wanted) {
  constexpr std::array<double, 3> times{5, 2, 1};
  const double rough = (axis.high - axis.low) / wanted;
  const auto ticks = [&](double step) {
    return std::floor(axis.high / step) - std::ceil(axis.low / step) + 1;
  };
  double power = std::pow(10, std::floor(std::log10(rough)) + 1), step = power;
  for (std::size_t i = 0; i < 3 * times.size(); ++i) {
    if (i % times.size() == 0) power /= 10;
    const double finer = times[i % times.size()] * power;
    if (finer < rough && ticks(step) >= 3) break;
    step = finer;
  }
  return axis.whole ? std::max(1.0, step) : step;
}

std::string tick_text(double value, double step) {
  const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, std::abs(value) < step / 2 ? 0 : value);
  std::string words = text.data();
  if (words.starts_with("-")) words.replace(0, 1, "\u2212");
  return words;
}

// One panel on the page.
struct Field {
  const Panel& panel;
  double left, top, width, height;

  double bottom() const { return top + height; }
  double x(double value) const {
    return left + (value - panel.x.low) / (panel.x.high - panel.x.low) * width;
  }
  double y(double value) const {
    return bottom() - (value - panel.y.low) / (panel.y.high - panel.y.low) * height;
  }
};

void draw_y_axis(Canvas& canvas, const Field& field) {
  const Axis& axis = field.panel.y;
  const double step = tick_step(axis, field.height / 45);
  for (double i = std::ceil(axis.low / step - 1e-9); i * step <= axis.high + 1e-9 * step; ++i) {
    const double y = field.y(i * step);
    canvas.line(field.left, y, field.left + field.width, y, 1, grid, Ends::cut);
    canvas.text(field.left - 10, y + tick_size * 0.36, tick_text(i * step, step), tick_size, ink,
                Align::right);
  }
  canvas.text(field.left - left_room + 12, field.top - 14, axis.label, label_size, ink, Align::left,
              field.width + left_room);
}

void draw_names(Canvas& canvas, const Field& field) {
  const std::vector<std::string>& names = field.panel.x.names;
  const double room = field.width / (field.panel.x.high - field.panel.x.low);
  // Names that would run into each other stand on two lines.
  double widest = 0;
  for (const std::string& name : names)
    widest = std::max(widest, canvas.text_width(name, tick_size));
  const bool two_lines = widest > room - 8;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double x = field.x(static_cast<double>(i));
    const double drop = two_lines && i % 2 == 1 ? 22 : 0;
    canvas.line(x, field.bottom(), x, field.bottom() + tick_length + drop, 1.5, quiet_ink,
                Ends::cut);
    canvas.text(x, field.bottom() + 23 + drop, names[i], tick_size, ink, Align::centre,
                (two_lines ? 2 : 1) * room - 6);
  }
}

void draw_x_axis(Canvas& canvas, const Field& field) {
  const Axis& axis = field.panel.x;
  if (!axis.names.empty()) {
    draw_names(canvas, field);
  } else {
    const double step = tick_step(axis, field.width / 90);
    for (double i = std::ceil(axis.low / step - 1e-9); i * step <= axis.high + 1e-9 * step; ++i) {
      const double x = field.x(i * step);
      canvas.line(x, field.bottom(), x, field.bottom() + tick_length, 1.5, quiet_ink, Ends::cut);
      canvas.text(x, field.bottom() + 24, tick_text(i * step, step), tick_size, ink, Align::centre);
    }
  }
  canvas.text(field.left + field.width / 2, field.bottom() + 51, axis.label, label_size, ink,
              Align::centre, field.width);
}

void draw_marker(Canvas& canvas, const Spot& at, Marker marker, Colour colour) {
  if (marker == Marker::none) return;
  if (marker == Marker::triangle) {
    canvas.mark(at.x, at.y - 1.2 * marker_radius, 2.6 * marker_radius, colour);
    return;
  }
  canvas.disc(at.x, at.y, marker_radius, colour);
  if (marker == Marker::ring) canvas.disc(at.x, at.y, marker_radius - 2, paper);
}

void draw_panel(Canvas& canvas, const Field& field) {
  draw_y_axis(canvas, field);
  draw_x_axis(canvas, field);
  const double right = field.left + field.width;
  for (const double rule : field.panel.rules)
    canvas.line(field.left, field.y(rule), right, field.y(rule), 1.5, quiet_ink, Ends::cut);
  for (const Series& series : field.panel.series) {
    std::vector<Spot> places;
    for (const Spot& point : series.points) places.push_back({field.x(point.x), field.y(point.y)});
    if (series.stroke != Stroke::none)
      canvas.lines(places, series.width, series.colour, dashes_of(series.stroke));
    for (const Spot& place : places) draw_marker(canvas, place, series.marker, series.colour);
  }
  canvas.line(field.left, field.top, field.left, field.bottom(), 1.5, quiet_ink, Ends::cut);
  canvas.line(field.left, field.bottom(), right, field.bottom(), 1.5, quiet_ink, Ends::cut);
}

std::vector<const Series*> legend_of(const Chart& chart) {
  std::vector<const Series*> entries;
  std::set<std::string> named;
  for (const Panel& panel : chart.panels)
    for (const Series& series : panel.series)
      if (!series.name.empty() && named.insert(series.name).second) entries.push_back(&series);
  return entries;
}

struct Page {
  double width = 0, height = 0, legend_y = 0, cell = 0;
  int legend_columns = 1;
  std::vector<std::string> note;  // line by line
};

std::vector<std::string> broken_into_lines(Canvas& measure, const std::string& text, double size,
                                           double room) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    std::string& line = lines.back();
    const std::string longer = line.empty() ? word : line + ' ' + word;
    if (line.empty() || measure.text_width(longer, size) <= room)
      line = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

// Text is measured on a page of its own: the real one's height depends on it.
Page page_for(const Chart& chart, const std::vector<const Series*>& legend) {
  Page page;
  const int count = static_cast<int>(chart.panels.size());
  const int columns = std::min(chart.columns, count), rows = (count + columns - 1) / columns;
  page.width = 2 * margin + columns * (left_room + chart.panel_width) + (columns - 1) * gap + 10;
  page.height = margin + title_size + rows * (top_room + chart.panel_height + bottom_room) +
                (rows - 1) * 6 + 10;
  page.legend_y = page.height + 22;
  Canvas measure = Canvas::of_pixels(1, 1);
  if (!legend.empty()) {
    for (const Series* series : legend)
      page.cell = std::max(page.cell, measure.text_width(series->name, label_size));
    page.cell = std::min(page.cell + legend_mark + 40, page.width - 2 * margin);
    page.legend_columns = std::max(1, static_cast<int>((page.width - 2 * margin) / page.cell));
    const int entries = static_cast<int>(legend.size());
    page.height += legend_line * ((entries + page.legend_columns - 1) / page.legend_columns) + 8;
  }
  if (!chart.note.empty()) {
    page.note = broken_into_lines(measure, chart.note, note_size, page.width - 2 * margin);
    page.height += note_line * static_cast<double>(page.note.size()) + 4;
  }
  page.height += margin / 2;
  return page;
}

void draw_chart(Canvas& canvas, const Chart& chart, const Page& page,
                const std::vector<const Series*>& legend) {
  canvas.text(margin, margin + title_size * 0.7, chart.title, title_size, ink, Align::left,
              page.width - 2 * margin);
  for (std::size_t i = 0; i < chart.panels.size(); ++i) {
    const int column = static_cast<int>(i) % chart.columns;
    const int row = static_cast<int>(i) / chart.columns;
    draw_panel(
        canvas,
        {chart.panels[i], margin + left_room + column * (left_room + chart.panel_width + gap),
         margin + title_size + top_room + row * (top_room + chart.panel_height + bottom_room + 6),
         chart.panel_width, chart.panel_height});
  }
  for (std::size_t i = 0; i < legend.size(); ++i) {
    const auto columns = static_cast<std::size_t>(page.legend_columns);
    const double x = margin + static_cast<double>(i % columns) * page.cell;
    const double y = page.legend_y + static_cast<double>(i / columns) * legend_line;
    const Series& series = *legend[i];
    const std::array<Spot, 2> sample{{{x, y - 6}, {x + legend_mark - 10, y - 6}}};
    if (series.stroke != Stroke::none)
      canvas.lines(sample, series.width, series.colour, dashes_of(series.stroke));
    draw_marker(canvas, {x + (legend_mark - 10) / 2, y - 6}, series.marker, series.colour);
    canvas.text(x + legend_mark, y, series.name, label_size, ink, Align::left,
                page.cell - legend_mark - 12);
  }
  for (std::size_t i = 0; i < page.note.size(); ++i)
    canvas.text(
        margin,
        page.height - margin / 2 - 6 - note_line * static_cast<double>(page.note.size() - 1 - i),
        page.note[i], note_size, quiet_ink, Align::left, page.width - 2 * margin);
}

void fit(Axis& axis, const std::vector<Series>& series, double Spot::*value, double room) {
  const bool given = axis.low < axis.high;
  double low = 1e300, high = -1e300;
  for (const Series& one : series)
    for (const Spot& point : one.points)
      low = std::min(low, point.*value), high = std::max(high, point.*value);
  if (low > high) low = 0, high = 1;
  const double more = high > low ? room * (high - low) : std::max(1e-3, 0.1 * std::abs(high));
  if (!given || low < axis.low) axis.low = low - more;
  if (!given || high > axis.high) axis.high = high + more;
}

}  // namespace

Colour line_colour(std::size_t line) {
  const Colour colour = colours[line % colours.size()];
  const double shade = line / colours.size() % 2 == 0 ? 1 : 0.55;
  return {shade * colour.red, shade * colour.green, shade * colour.blue};
}

Stroke line_stroke(std::size_t line) {
  constexpr std::array strokes{Stroke::solid, Stroke::dashed, Stroke::dotted};
  return strokes[line / colours.size() % strokes.size()];
}

Marker line_marker(std::size_t line) {
  return line / colours.size() % 2 == 0 ? Marker::disc : Marker::triangle;
}

void fit_x(Panel& panel) { fit(panel.x, panel.series, &Spot::x, 0.02); }
void fit_y(Panel& panel) { fit(panel.y, panel.series, &Spot::y, 0.07); }

void write_chart(const Chart& chart, const std::filesystem::path& path) {
  const std::vector<const Series*> legend = legend_of(chart);
  const Page page = page_for(chart, legend);
  write_picture(path, page.width, page.height,
                [&](Canvas& canvas) { draw_chart(canvas, chart, page, legend); });
}

}  // namespace gait::tool
