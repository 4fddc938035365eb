#include "draw/canvas.h"

#include <cairo-svg.h>

#include <cmath>
#include <numbers>

#include "file_ending.h"
#include "gait/error.h"
#include "gait/platform/whole_file.h"

namespace gait::tool {

namespace {

constexpr int largest_side = 32767;  // Cairo's limit for pixels

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(std::string("the picture cannot be drawn: ") + cairo_status_to_string(status));
}

cairo_status_t append_bytes(void* bytes, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

// The text without its last character, whole characters of UTF-8.
std::string shorter(std::string text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
  if (!text.empty()) text.pop_back();
  return text;
}

}  // namespace

Canvas::Canvas(cairo_surface_t* surface, int width, int height)
    : surface_(surface), width_(width), height_(height) {
  check(cairo_surface_status(surface));
  context_.reset(cairo_create(surface));
  check(cairo_status(context_.get()));
  cairo_select_font_face(context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
  // Screen settings must not change a picture.
  const std::unique_ptr<cairo_font_options_t, decltype(&cairo_font_options_destroy)> options(
      cairo_font_options_create(), &cairo_font_options_destroy);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(context_.get(), options.get());
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  clear();
}

Canvas Canvas::of_pixels(int width, int height) {
  if (width > largest_side || height > largest_side)
    throw Error("the picture would be " + std::to_string(width) + " x " + std::to_string(height) +
                " pixels, at most " + std::to_string(largest_side) +
                " each way can be drawn: give fewer clips, or an .svg");
  return Canvas(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), width, height);
}

Canvas Canvas::of_svg(int width, int height) {
  auto bytes = std::make_unique<std::string>();
  cairo_surface_t* surface =
      cairo_svg_surface_create_for_stream(append_bytes, bytes.get(), width, height);
  if (cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS)
    cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
  Canvas canvas(surface, width, height);
  canvas.bytes_ = std::move(bytes);
  return canvas;
}

void Canvas::clear() {
  colour(paper);
  cairo_paint(context_.get());
}

void Canvas::line(double x0, double y0, double x1, double y1, double width, Colour stroke,
                  Ends ends) {
  colour(stroke);
  cairo_set_line_cap(context_.get(),
                     ends == Ends::round ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
  cairo_set_line_width(context_.get(), width);
  cairo_move_to(context_.get(), x0, y0);
  cairo_line_to(context_.get(), x1, y1);
  cairo_stroke(context_.get());
}

void Canvas::lines(std::span<const Spot> points, double width, Colour stroke,
                   std::span<const double> dashes) {
  if (points.empty()) return;
  colour(stroke);
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_BUTT);
  cairo_set_line_width(context_.get(), width);
  cairo_set_dash(context_.get(), dashes.data(), static_cast<int>(dashes.size()), 0);
  cairo_new_path(context_.get());
  for (const Spot& point : points) cairo_line_to(context_.get(), point.x, point.y);
  cairo_stroke(context_.get());
  cairo_set_dash(context_.get(), nullptr, 0, 0);
}

void Canvas::disc(double x, double y, double radius, Colour fill) {
  colour(fill);
  cairo_new_sub_path(context_.get());
  cairo_arc(context_.get(), x, y, radius, 0, 2 * std::numbers::pi);
  cairo_fill(context_.get());
}

void Canvas::mark(double x, double y, double size, Colour fill) {
  colour(fill);
  cairo_move_to(context_.get(), x, y);
  cairo_line_to(context_.get(), x + size / 2, y + size);
  cairo_line_to(context_.get(), x - size / 2, y + size);
  cairo_close_path(context_.get());
  cairo_fill(context_.get());
}

double Canvas::text_width(const std::string& text, double size) {
  cairo_set_font_size(context_.get(), size);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), text.c_str(), &extents);
  return extents.x_advance;
}

double Canvas::text(double x, double y, const std::string& text, double size, Colour fill,
                    Align align, double room) {
  std::string shown = text, kept = text;
  double width = text_width(shown, size);
  while (width > room && !kept.empty()) {
    kept = shorter(kept);
    shown = kept + "…";
    width = text_width(shown, size);
  }
  if (align == Align::centre) x -= width / 2;
  if (align == Align::right) x -= width;
  colour(fill);
  cairo_move_to(context_.get(), x, y);
  cairo_show_text(context_.get(), shown.c_str());
  return width;
}

std::string Canvas::png() {
  check(cairo_status(context_.get()));
  std::string bytes;
  check(cairo_surface_write_to_png_stream(surface_.get(), append_bytes, &bytes));
  return bytes;
}

std::string Canvas::svg() {
  check(cairo_status(context_.get()));
  cairo_surface_finish(surface_.get());
  check(cairo_surface_status(surface_.get()));
  return std::move(*bytes_);
}

const unsigned char* Canvas::pixels() {
  cairo_surface_flush(surface_.get());
  return cairo_image_surface_get_data(surface_.get());
}

void write_picture(const std::filesystem::path& path, double width, double height,
                   const std::function<void(Canvas&)>& draw) {
  const int columns = static_cast<int>(std::lround(width));
  const int rows = static_cast<int>(std::lround(height));
  WholeFile output(path);
  const bool svg = ending_of(path) == ".svg";
  Canvas canvas = svg ? Canvas::of_svg(columns, rows) : Canvas::of_pixels(columns, rows);
  draw(canvas);
  output.write(svg ? canvas.svg() : canvas.png());
  output.keep();
}

}  // namespace gait::tool
