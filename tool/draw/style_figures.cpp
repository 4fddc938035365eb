// Figures of the space of styles (T10).
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "draw/model_figures.h"
#include "gait/error.h"
#include "gait/judge/space_summary.h"
#include "gait/play/cycles/style_walker.h"

namespace gait::tool {

namespace {

constexpr int shown_cycles = 12;  // of each style's walk

const StyleSpace& styles_of(const Model& model) {
  if (!model.style_space)
    throw Error("model " + model.name +
                ": expected a space of styles; it has none: train it from walks whose styles are "
                "named");
  return *model.style_space;
}

// Styles that walk, as an axis' names, and their places in the model.
struct Walking {
  std::vector<std::string> names;
  std::vector<std::size_t> styles;
};

Walking walking_styles(const Model& model) {
  Walking walking;
  for (std::size_t i = 0; i < model.styles.size(); ++i)
    if (styles_of(model).styles[i].cycles > 0) {
      walking.names.push_back(model.styles[i]);
      walking.styles.push_back(i);
    }
  return walking;
}

std::string share_text(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

std::string score_label(const CycleSpace& space, int score) {
  const double total = space.variances.sum();
  return "score " + std::to_string(score + 1) + ", rad (" +
         share_text(total > 0 ? space.variances[score] / total : 0) + " of variance)";
}

}  // namespace

Chart variance_figure(const Model& model) {
  if (!model.style_space && model.speed_spaces.empty())
    throw Error("model " + model.name +
                ": expected a space of styles or of walks over speed; it has neither: train it "
                "from walks whose styles are named, or with clips of several speeds");
  Chart chart;
  chart.title = "What few components carry";
  Panel panel;
  panel.x = {"components", 0, 0, true, {}};
  panel.y = {"cumulated variance, %", 0, 100, false, {}};
  panel.rules = {80, 90};
  std::size_t most = 0;
  const auto add = [&](const std::string& name, const CycleSpace& space, std::size_t line) {
    Series series{name, line_colour(line), line_stroke(line), Marker::none, 2.5, {}};
    for (const double share : cumulated_shares(space))
      series.points.push_back({static_cast<double>(series.points.size()), 100 * share});
    // Beyond this nothing more is to be seen.
    most = std::max(most, static_cast<std::size_t>(space.components_for(0.99)));
    panel.series.push_back(std::move(series));
  };
  std::size_t line = 0;
  if (model.style_space) add("styles", model.style_space->space, line++);
  for (const SpeedSpace& subject : model.speed_spaces)
    add("speeds of " + subject.subject, subject.space, line++);
  if (model.shared_speed_space) add("speeds of all", *model.shared_speed_space, line++);
  panel.x.high = static_cast<double>(std::max<std::size_t>(most + 1, 10));
  for (Series& series : panel.series)
    series.points.resize(
        std::min(series.points.size(), static_cast<std::size_t>(panel.x.high) + 1));
  chart.panels.push_back(std::move(panel));
  chart.panel_width = 900, chart.panel_height = 480;
  chart.note = "After T10 fig. 2 and G04 fig. 3. Thin lines: 80 % (G04) and 90 % (T10).";
  return chart;
}

Chart scores_figure(const Model& model) {
  const StyleSpace& styles = styles_of(model);
  const Walking walking = walking_styles(model);
  Chart chart;
  chart.title = "First scores of each style's cycles";
  chart.columns = 2;
  for (int score = 0; score < std::min(shown_scores, styles.space.kept()); ++score) {
    Panel panel;
    panel.x = {"", -0.6, static_cast<double>(walking.names.size()) - 0.4, true, walking.names};
    panel.y.label = score_label(styles.space, score);
    panel.rules = {0};
    Series mean{"mean", ink, Stroke::none, Marker::disc, 2, {}};
    Series cycles{"cycle", line_colour(4), Stroke::none, Marker::ring, 1, {}};
    for (std::size_t i = 0; i < walking.styles.size(); ++i) {
      const auto x = static_cast<double>(i);
      const Variation& values =
          styles.styles[walking.styles[i]].scores[static_cast<std::size_t>(score)];
      const StyleCycles& style = styles.styles[walking.styles[i]];
      for (int cycle = 0; cycle < style.cycles; ++cycle)
        cycles.points.push_back(
            {x + 0.5 * ((cycle + 0.5) / style.cycles - 0.5), style.projected(score, cycle)});
      panel.series.push_back(
          {"a deviation each way",
           line_colour(0),
           Stroke::solid,
           Marker::none,
           9,
           {{x, values.mean - values.deviation}, {x, values.mean + values.deviation}}});
      mean.points.push_back({x, values.mean});
    }
    panel.series.push_back(std::move(cycles));
    panel.series.push_back(std::move(mean));
    fit_y(panel);
    chart.panels.push_back(std::move(panel));
  }
  chart.panel_width = 660;
  chart.note = "After T10 fig. 3.";
  return chart;
}

Chart cycles_figure(const std::shared_ptr<const Model>& model, std::uint64_t seed) {
  const StyleSpace& styles = styles_of(*model);
  const Walking walking = walking_styles(*model);
  const int scores = std::min(shown_scores, styles.space.kept());
  Chart chart;
  chart.title = std::to_string(shown_cycles) + " cycles that follow each other, style by style";
  for (int i = 0; i <= scores; ++i) {
    Panel panel;
    panel.x = {"", -0.55, static_cast<double>(walking.names.size()) - 0.45, true, walking.names};
    panel.y.label = i == 0 ? "duration of a cycle, s" : score_label(styles.space, i - 1);
    chart.panels.push_back(std::move(panel));
  }
  for (std::size_t s = 0; s < walking.styles.size(); ++s) {
    StyleWalker walker(model, seed);
    walker.set_style(static_cast<int>(walking.styles[s]));
    std::vector<Series> lines(static_cast<std::size_t>(scores) + 1,
                              {"", line_colour(0), Stroke::solid, Marker::disc, 1.5, {}});
    for (int cycle = 0; cycle < shown_cycles; ++cycle) {
      const double x = static_cast<double>(s) + 0.8 * ((cycle + 0.5) / shown_cycles - 0.5);
      lines[0].points.push_back({x, walker.duration()});
      for (int i = 0; i < scores; ++i)
        lines[static_cast<std::size_t>(i) + 1].points.push_back({x, walker.scores()[i]});
      // Scores hold from the join of one cycle to that of the next: a cycle on, any time will do.
      const auto now = walker.cycle();
      while (walker.cycle() == now) walker.advance(0.01);
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const StyleCycles& learnt = styles.styles[walking.styles[s]];
      const Variation& seen = i == 0 ? learnt.duration : learnt.scores[i - 1];
      for (const double end : {seen.lowest, seen.highest})
        chart.panels[i].series.push_back(
            {"range of the training's cycles",
             line_colour(1),
             Stroke::solid,
             Marker::none,
             2,
             {{static_cast<double>(s) - 0.42, end}, {static_cast<double>(s) + 0.42, end}}});
      chart.panels[i].series.push_back(std::move(lines[i]));
    }
  }
  for (Panel& panel : chart.panels) {
    panel.series.front().name = "range of the training's cycles";
    panel.series.back().name = "synthesised cycle";
    fit_y(panel);
  }
  chart.panel_width = 1340, chart.panel_height = 190;
  chart.note =
      "After T10 fig. 4, from a synthesised walk of each style, seed " + std::to_string(seed) + ".";
  return chart;
}

}  // namespace gait::tool
