// A page to draw on with Cairo: pixels or SVG. Lengths in pixels, y downwards.
#pragma once

#include <cairo.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace gait::tool {

struct Spot {
  double x = 0, y = 0;
};

struct Colour {
  double red = 0, green = 0, blue = 0;  // 0 to 1
};

// Blue and orange stay apart for every kind of colour vision, dark and light on grey paper.
inline constexpr Colour ink{0.13, 0.13, 0.15};
inline constexpr Colour quiet_ink{0.42, 0.42, 0.45};
inline constexpr Colour paper{1, 1, 1};
inline constexpr Colour left_colour{0.05, 0.25, 0.55};
inline constexpr Colour right_colour{0.95, 0.52, 0.10};
inline constexpr Colour middle_colour{0.30, 0.30, 0.33};
inline constexpr Colour compared_colour{0.74, 0.74, 0.76};

enum class Ends { round, cut };
enum class Align { left, centre, right };

class Canvas {
 public:
  // Pixels in memory, 32 bits each, blue first. Throws Error when it is too large.
  static Canvas of_pixels(int width, int height);
  static Canvas of_svg(int width, int height);

  void clear();
  void line(double x0, double y0, double x1, double y1, double width, Colour colour,
            Ends ends = Ends::round);
  // Through all points. `dashes`: lengths drawn and left out in turn; none: unbroken.
  void lines(std::span<const Spot> points, double width, Colour colour,
             std::span<const double> dashes = {});
  void disc(double x, double y, double radius, Colour colour);
  // A triangle that points up, its tip at (x, y).
  void mark(double x, double y, double size, Colour colour);

  // `y`: the baseline. Text wider than `room` is cut with an ellipsis. Returns its width.
  double text(double x, double y, const std::string& text, double size, Colour colour,
              Align align = Align::left, double room = 1e9);
  double text_width(const std::string& text, double size);

  std::string png();              // of_pixels only: the file's bytes; throws Error
  std::string svg();              // of_svg only, the last call: the file's bytes; throws Error
  const unsigned char* pixels();  // of_pixels only; rows without gaps
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
  };
  Canvas(cairo_surface_t* surface, int width, int height);
  void colour(Colour colour) {
    cairo_set_source_rgb(context_.get(), colour.red, colour.green, colour.blue);
  }

  std::unique_ptr<std::string> bytes_;  // what the surface below wrote; null: pixels
  std::unique_ptr<cairo_surface_t, Destroy> surface_;
  std::unique_ptr<cairo_t, Destroy> context_;
  int width_, height_;
};

// Writes what `draw` draws as SVG where the path ends in .svg, as PNG elsewhere; whole or not at
// all. Width and height in pixels, rounded. Throws Error when it cannot be drawn or written.
void write_picture(const std::filesystem::path& path, double width, double height,
                   const std::function<void(Canvas&)>& draw);

}  // namespace gait::tool
