#include "draw/speed_grid.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "clip_reader.h"
#include "draw/stick_figure.h"
#include "draw/walk_view.h"
#include "gait/model/body_pose.h"
#include "gait/offline/planned_walk.h"
#include "number_words.h"

namespace gait::tool {

namespace {

// Pixels.
constexpr double margin = 36, title_size = 22, label_size = 18, row_title = 40, row_gap = 52;
constexpr double cell_gap = 46, legend_room = 56, tallest = 300;
constexpr double narrowest = 44;  // half of what stands under a figure

struct Cell {
  WalkView view;
  int frame = 0;
  double speed = 0;                        // m/s, as walked
  double left = 0, right = 0, height = 0;  // metres
};

struct Row {
  double leg_length = 0;
  std::vector<Cell> cells;
};

// The last frame of a right contact, where phase begins anew; frame 0 for a walker that stands.
int contact_frame(const SpeedWalk& walk) {
  for (int frame = static_cast<int>(walk.phase.size()) - 1; frame > 0; --frame) {
    const auto at = static_cast<std::size_t>(frame);
    if (walk.phase[at] < walk.phase[at - 1]) return frame;
  }
  return 0;
}

Cell cell_of(const SpeedWalk& walk, const JointRoles& roles, double degrees) {
  Cell cell;
  cell.view = view_walk(walk.clip, roles, degrees);
  cell.frame = contact_frame(walk);
  cell.speed = walk.speed.back();
  for (std::size_t i = 0; i < cell.view.figure.points.size(); ++i) {
    if (!cell.view.figure.drawn[i]) continue;
    const Eigen::Vector3d& point = cell.view.point(cell.frame, static_cast<int>(i));
    cell.left = std::min(cell.left, point.x());
    cell.right = std::max(cell.right, point.x());
    const bool head = static_cast<int>(i) == cell.view.figure.head_centre;
    cell.height = std::max(cell.height, point.y() + (head ? cell.view.figure.head_radius : 0));
  }
  return cell;
}

struct Page {
  double scale = 100, width = 0, height = 0;
  std::vector<double> column_x;  // of the walkers' own places
  std::vector<double> ground_y;  // per row
};

Page lay_out(const std::vector<Row>& rows, std::size_t columns) {
  Page page;
  double highest = 0;
  for (const Row& row : rows)
    for (const Cell& cell : row.cells) highest = std::max(highest, cell.height);
  page.scale = tallest / highest;
  double x = margin;
  for (std::size_t column = 0; column < columns; ++column) {
    double left = narrowest / page.scale, right = left;
    for (const Row& row : rows) {
      left = std::max(left, -row.cells[column].left);
      right = std::max(right, row.cells[column].right);
    }
    page.column_x.push_back(x + page.scale * left);
    x += page.scale * (left + right) + cell_gap;
  }
  page.width = x - cell_gap + margin;
  double y = margin;
  for (const Row& row : rows) {
    double high = 0;
    for (const Cell& cell : row.cells) high = std::max(high, cell.height);
    y += row_title + page.scale * high;
    page.ground_y.push_back(y);
    y += row_gap;
  }
  page.height = y + legend_room;
  return page;
}

void draw(Canvas& canvas, const std::vector<Row>& rows, const Page& page) {
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double ground = page.ground_y[r];
    double high = 0;
    for (const Cell& cell : rows[r].cells) high = std::max(high, cell.height);
    canvas.text(margin, ground - page.scale * high - 14,
                "leg " + in_words("%.2f m", rows[r].leg_length), title_size, ink);
    canvas.line(margin, ground, page.width - margin, ground, 1.5, quiet_ink);
    for (std::size_t c = 0; c < rows[r].cells.size(); ++c) {
      const Cell& cell = rows[r].cells[c];
      draw_figure(canvas, cell.view, cell.frame, {page.column_x[c], ground, page.scale},
                  Tone::coloured);
      canvas.text(page.column_x[c], ground + 8 + label_size,
                  in_words("%.3g km/h", cell.speed * 3.6), label_size, quiet_ink, Align::centre);
    }
  }
  double x = margin;
  const double y = page.height - margin;
  for (const auto& [word, colour] : {std::pair{"left", left_colour}, {"right", right_colour}}) {
    canvas.line(x + 4, y - 6, x + 30, y - 6, 7, colour);
    x += 72 + canvas.text(x + 40, y, word, label_size, ink);
  }
  canvas.text(x, y, "at right contact", label_size, quiet_ink, Align::left,
              page.width - margin - x);
}

}  // namespace

void write_speed_grid(const std::shared_ptr<const Model>& model, const SpeedGrid& grid,
                      const std::filesystem::path& path) {
  const PlayModel played(model);
  const JointRoles roles = body_roles(*model->body);
  std::vector<double> legs = grid.leg_lengths;
  if (legs.empty()) legs.push_back(0);
  std::vector<Row> rows;
  std::set<std::string> remarks;
  for (const double leg : legs) {
    Row row;
    for (const double speed : grid.speeds) {
      SpeedWalkPlan plan;
      plan.from = plan.to = speed;
      plan.leg_length = leg;
      plan.seconds = 4;  // two contacts at the slowest
      const SpeedWalk walk = speed_walk(played, plan);
      remarks.insert(walk.remarks.begin(), walk.remarks.end());
      row.leg_length = walk.leg_length;
      row.cells.push_back(cell_of(walk, roles, grid.camera_degrees));
    }
    rows.push_back(std::move(row));
  }
  print_warnings("render", {remarks.begin(), remarks.end()});
  const Page page = lay_out(rows, grid.speeds.size());
  write_picture(path, page.width, page.height, [&](Canvas& canvas) { draw(canvas, rows, page); });
}

}  // namespace gait::tool
