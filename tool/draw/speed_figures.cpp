// Figures of walks over speed (G04).
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "draw/model_figures.h"
#include "gait/error.h"
#include "gait/names.h"
#include "gait/play/cycles/speed_walker.h"

namespace gait::tool {

namespace {

constexpr const char* speed_label = "speed V, leg lengths per second";

const std::vector<SpeedSpace>& speeds_of(const Model& model) {
  if (model.speed_spaces.empty())
    throw Error("model " + model.name +
                ": expected walks over speed; it has none: train it with clips of several speeds");
  return model.speed_spaces;
}

// V at which the walker's range ends, 10 km/h on this subject's legs.
double highest(const SpeedSpace& subject) {
  return std::min<double>(highest_speed_per_leg, highest_speed / subject.leg_length);
}

// What is drawn of one subject: lines of scores in some space.
struct Lines {
  const SpeedSpace& subject;
  const Eigen::VectorXd &intercept, &slope, &standing;
  const Eigen::MatrixXd& projected;
};

std::vector<Lines> all_lines(const Model& model, const std::string& only) {
  std::vector<Lines> lines;
  std::string known;
  const bool shared = model.shared_speed_space.has_value() && only.empty();
  for (const SpeedSpace& subject : speeds_of(model)) {
    append_name(known, subject.subject);
    if (!only.empty() && subject.subject != only) continue;
    if (shared && subject.shared.intercept.size() > 0)
      lines.push_back({subject, subject.shared.intercept, subject.shared.slope,
                       subject.shared.standing, subject.shared.projected});
    else if (!shared)
      lines.push_back(
          {subject, subject.intercept, subject.slope, subject.standing, subject.projected});
  }
  if (lines.empty())
    throw Error("model " + model.name + ": no subject is called '" + only + "'; it has " + known);
  return lines;
}

void add_lines(Panel& panel, const Lines& lines, Eigen::Index score, std::size_t line) {
  const auto at = [&](double speed) {
    return Spot{speed, lines.intercept[score] + speed * lines.slope[score]};
  };
  const SpeedSpace& subject = lines.subject;
  const Colour colour = line_colour(line);
  const Spot standing{0, lines.standing[score]};
  panel.series.push_back(
      {"", colour, Stroke::dotted, Marker::none, 2, {standing, at(subject.slowest)}});
  panel.series.push_back(
      {"", colour, Stroke::dotted, Marker::none, 2, {at(subject.fastest), at(highest(subject))}});
  panel.series.push_back(
      {"", colour, Stroke::solid, Marker::none, 3, {at(subject.slowest), at(subject.fastest)}});
  panel.series.push_back({"", colour, Stroke::none, Marker::ring, 2, {standing}});
  Series cycles{subject.subject, colour, Stroke::none, line_marker(line), 1, {}};
  for (int i = 0; i < subject.cycles; ++i)
    cycles.points.push_back({subject.speeds[i], lines.projected(score, i)});
  panel.series.push_back(std::move(cycles));
}

std::string law_text(double scale, double power) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3f V^%.3f", scale, power);
  return text;
}

template <typename Law>
std::vector<Spot> law_points(double from, double to, Law law) {
  constexpr int steps = 60;
  std::vector<Spot> points;
  for (int i = 0; i <= steps; ++i) {
    // Closer together where laws bend most.
    const double share = static_cast<double>(i) / steps;
    const double speed = from + (to - from) * share * share;
    points.push_back({speed, law(speed)});
  }
  return points;
}

}  // namespace

Chart speed_figure(const Model& model, const std::string& subject) {
  const std::vector<Lines> lines = all_lines(model, subject);
  Chart chart;
  chart.title =
      !subject.empty() ? "Scores over speed, " + subject : "Scores over speed, a line per subject";
  chart.columns = 2;
  Eigen::Index scores = shown_scores;
  for (const Lines& one : lines) scores = std::min(scores, one.intercept.size());
  for (Eigen::Index score = 0; score < scores; ++score) {
    Panel panel;
    panel.x = {speed_label, -0.1, 0.5, false, {}};
    panel.y.label = "score " + std::to_string(score + 1) + ", rad";
    for (std::size_t i = 0; i < lines.size(); ++i) add_lines(panel, lines[i], score, i);
    fit_x(panel);
    fit_y(panel);
    chart.panels.push_back(std::move(panel));
  }
  chart.note =
      "After G04 fig. 4 to 6. Marks: captured cycles. Unbroken: over the captured speeds; dotted: "
      "down to standing (ring) and on to 10 km/h.";
  return chart;
}

Chart frequency_figure(const std::shared_ptr<const Model>& model) {
  Chart chart;
  chart.title = "Frequency over speed";
  Panel panel;
  panel.x = {speed_label, 0, 0.5, false, {}};
  panel.y = {"frequency, cycles per second", 0, 0.5, false, {}};
  double most = 0;
  for (const SpeedSpace& subject : speeds_of(*model)) most = std::max(most, highest(subject));
  panel.series.push_back({"Inman's law, 0.743 V^0.5", quiet_ink, Stroke::dashed, Marker::none, 2.5,
                          law_points(0, most, [](double v) { return 0.743 * std::sqrt(v); })});
  SpeedWalker walker(make_speed_tables(*model));
  walker.set_law(SpeedLaw::feet);
  std::size_t line = 0;
  for (const SpeedSpace& subject : model->speed_spaces) {
    const Colour colour = line_colour(line);
    const auto fitted = [&](double v) {
      return subject.frequency_scale * std::pow(v, subject.frequency_power);
    };
    panel.series.push_back({"", colour, Stroke::solid, Marker::none, 3,
                            law_points(subject.slowest, subject.fastest, fitted)});
    panel.series.push_back(
        {"", colour, Stroke::solid, Marker::none, 1.2, law_points(0, highest(subject), fitted)});
    Series cycles{
        subject.subject + ", " + law_text(subject.frequency_scale, subject.frequency_power),
        colour,
        Stroke::none,
        line_marker(line++),
        1,
        {}};
    for (int i = 0; i < subject.cycles; ++i)
      cycles.points.push_back({subject.speeds[i], subject.frequencies[i]});
    panel.series.push_back(std::move(cycles));
    walker.set_subject(subject.subject);
    const auto of_feet = [&](double v) {
      walker.set_speed(static_cast<float>(v * subject.leg_length));
      walker.settle();
      walker.advance(1e-4);
      return static_cast<double>(walker.frequency());
    };
    panel.series.push_back(
        {"", colour, Stroke::dotted, Marker::none, 2, law_points(0.1, highest(subject), of_feet)});
  }
  fit_x(panel);
  fit_y(panel);
  chart.panels.push_back(std::move(panel));
  chart.panel_width = 900, chart.panel_height = 520;
  chart.note =
      "After G04 fig. 7. Marks: captured cycles. Lines: the law a V^b, thick over the captured "
      "speeds; dotted: the frequency at which the feet travel at V (law feet).";
  return chart;
}

}  // namespace gait::tool
