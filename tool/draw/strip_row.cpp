#include "draw/strip_row.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gait::tool {

namespace {

constexpr int usual_figures = 12;

// All in body heights.
constexpr double shortest_travel = 1.2;    // less: figures would stand in one another
constexpr double longest_travel = 12;      // more: figures would be too small to read
constexpr double good_distance = 0.2;      // between figures, when it is ours to choose
constexpr double closest_distance = 0.12;  // what a user may ask for with --strobe
constexpr double gap = 0.12;               // between figures side by side
constexpr double half_limb = 0.015;        // half a limb's thickness

// Where the walk begins and ends: standing at either end would pile figures up.
constexpr double still_share = 0.01;  // of the whole travel

struct Frames {
  int first = 0, last = 0;
};

Frames walking_part(const std::vector<double>& travel) {
  Frames part{0, static_cast<int>(travel.size()) - 1};
  const double still = still_share * std::abs(travel.back() - travel.front());
  while (part.first < part.last && std::abs(travel[part.first + 1] - travel.front()) < still)
    ++part.first;
  while (part.last > part.first && std::abs(travel[part.last - 1] - travel.back()) < still)
    --part.last;
  return part;
}

std::vector<int> evenly(Frames part, int count) {
  const int available = part.last - part.first + 1;
  count = std::clamp(count, 1, available);
  std::vector<int> frames;
  for (int i = 0; i < count; ++i)
    frames.push_back(part.first +
                     (count == 1 ? 0
                                 : static_cast<int>(std::lround(static_cast<double>(i) *
                                                                (available - 1) / (count - 1)))));
  return frames;
}

// Figures for a walk of this length. A stroboscope in step with the walker would show the same pose
// again and again: the number is chosen so that each figure is at another phase than its neighbour.
int figures_for(const WalkView& view, Frames part) {
  const double way = std::abs(view.travel[part.last] - view.travel[part.first]) / view.height;
  double frames_per_step = 0;
  if (view.footprints.size() > 2)
    frames_per_step =
        static_cast<double>(view.footprints.back().frame - view.footprints.front().frame) /
        static_cast<double>(view.footprints.size() - 1);
  // Seen from an angle figures are wider.
  const double closest = good_distance + 0.3 * (1 - view.foreshortening);
  int best = 2;
  double least = std::numeric_limits<double>::max();
  for (int count = 5; count <= usual_figures + 4; ++count) {
    if (way / (count - 1) < closest) break;
    double cost = std::abs(count - usual_figures) / static_cast<double>(usual_figures);
    if (frames_per_step > 0) {
      const double steps = (part.last - part.first) / (count - 1.0) / frames_per_step;
      cost += 3 * std::max(0.0, 1.0 / 3 - std::abs(steps - std::round(steps)));
    }
    if (cost < least) least = cost, best = count;
  }
  return best;
}

// Frames of a walk's figures when they can stand where they were; empty when they cannot.
std::vector<int> along_the_way(const WalkView& view, int strobe) {
  const double way = std::abs(view.travel.back() - view.travel.front()) / view.height;
  const auto [low, high] = std::minmax_element(view.travel.begin(), view.travel.end());
  const bool turns_back = (*high - *low) / view.height > 1.1 * way;
  if (way < shortest_travel || way > longest_travel || turns_back) return {};
  const Frames part = walking_part(view.travel);
  std::vector<int> frames = evenly(part, strobe > 0 ? strobe : figures_for(view, part));
  // The figures of a walker that stops on the way would stand on one spot, one over the other.
  const double mean = way / static_cast<double>(std::max<std::size_t>(1, frames.size() - 1));
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (std::abs(view.travel[frames[i]] - view.travel[frames[i - 1]]) / view.height <
        std::max(0.3 * mean, strobe > 0 ? closest_distance : 0))
      return {};
  return frames;
}

Extent extent_at(const StripRow& row, int frame) {
  Extent extent;
  extent.include(*row.view, frame, half_limb * row.view->height);
  if (row.compared != nullptr && row.compared_frame(frame) >= 0)
    extent.include(*row.compared, row.compared_frame(frame), half_limb * row.compared->height);
  return extent;
}

}  // namespace

int StripRow::compared_frame(int frame) const {
  const long matching = std::lround(frame / view->frame_rate * compared->frame_rate);
  return matching < compared->frames ? static_cast<int>(matching) : -1;
}

double StripRow::x_of_travel(double travel) const {
  return figures.front().x + travel - view->travel[figures.front().frame];
}

double StripRow::x_of_frame(double frame) const {
  if (figures.size() < 2) return figures.front().x;
  const double share = (frame - figures.front().frame) /
                       static_cast<double>(figures.back().frame - figures.front().frame);
  return figures.front().x + share * (figures.back().x - figures.front().x);
}

StripRow lay_out_row(const WalkView& view, const WalkView* compared, int strobe) {
  StripRow row;
  row.view = &view;
  row.compared = compared;
  std::vector<int> frames = along_the_way(view, strobe);
  row.spread = frames.empty() ? Spread::by_time : Spread::by_travel;
  if (frames.empty()) frames = evenly({0, view.frames - 1}, strobe > 0 ? strobe : usual_figures);

  std::vector<Extent> extents;
  double widest = 0;
  for (const int frame : frames) {
    extents.push_back(extent_at(row, frame));
    widest = std::max(widest, extents.back().right - extents.back().left);
    row.height = std::max(row.height, extents.back().high);
    row.depth = std::max(row.depth, -extents.back().low);
  }
  Extent all;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double x = row.spread == Spread::by_travel
                         ? view.travel[frames[i]]
                         : static_cast<double>(i) * (widest + gap * view.height);
    row.figures.push_back({frames[i], x});
    all.left = std::min(all.left, x + extents[i].left);
    all.right = std::max(all.right, x + extents[i].right);
  }
  for (ShownFigure& figure : row.figures) figure.x -= all.left;
  row.width = all.right - all.left;
  return row;
}

}  // namespace gait::tool
