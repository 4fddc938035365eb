// A figure of panels with axes, lines and points, drawn with Cairo: for print as for the screen.
//
// Panels lie row by row; all of them share the legend below. Colours stay apart for every kind of
// colour vision (Okabe and Ito 2008); where there are more lines than colours they come again
// darker, with other marks and dashes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "draw/canvas.h"

namespace gait::tool {

enum class Stroke { none, solid, dashed, dotted };
enum class Marker { none, disc, ring, triangle };

struct Series {
  std::string name;  // in the legend, once for each name; empty: not there
  Colour colour = ink;
  Stroke stroke = Stroke::solid;
  Marker marker = Marker::none;
  double width = 2.5;  // pixels
  std::vector<Spot> points;
};

struct Axis {
  std::string label;  // with its unit
  double low = 0, high = 0;
  bool whole = false;              // counts things: no ticks between
  std::vector<std::string> names;  // of things at 0, 1, 2, ... instead of numbers
};

struct Panel {
  Axis x, y;
  std::vector<Series> series;
  std::vector<double> rules;  // y at which a thin line goes across
};

struct Chart {
  std::string title, note;  // note: small print below
  std::vector<Panel> panels;
  int columns = 1;
  double panel_width = 620, panel_height = 300;  // pixels, of the field within the axes
};

// The colour, stroke and mark of line 0, 1, 2, ..., each line unlike the ones before.
Colour line_colour(std::size_t line);
Stroke line_stroke(std::size_t line);
Marker line_marker(std::size_t line);

// Widens an axis so that all points of the panel's series lie well inside. What was set (low below
// high) only grows.
void fit_x(Panel& panel);
void fit_y(Panel& panel);

// Writes the picture, .svg or .png as `path` ends. Throws Error when it cannot be written.
void write_chart(const Chart& chart, const std::filesystem::path& path);

}  // namespace gait::tool
