#include "gait/model/cycle_space_check.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "gait/model/field_check.h"

namespace gait {

namespace {

constexpr int most_frames = 1000;        // per cycle
constexpr double longest_cycle = 60;     // seconds
constexpr double longest_leg = 100;      // metres: puppets may be tall
constexpr double fastest_walk = 100;     // V, leg lengths per second
constexpr double unit_tolerance = 1e-6;  // of a component's length

void check_space(const CycleSpace& space, const Body& body, const std::string& field) {
  if (space.frames < 2 || space.frames > most_frames || space.frames % 2 != 0)
    fail(field + ".frames", "an even number from 2 to " + std::to_string(most_frames) + ", found " +
                                std::to_string(space.frames));
  expect_indices(space.joints, body.skeleton.size(), field + ".joints");
  if (space.joints.empty() || !std::ranges::is_sorted(space.joints))
    fail(field + ".joints", "at least one joint, ascending");
  expect_values(space.mean, space.values(), 1, field + ".mean");
  expect_values(space.components, space.values(), space.kept(), field + ".components");
  if (space.kept() > space.variances.size())
    fail(field + ".components", "at most " + std::to_string(space.variances.size()) +
                                    " columns, as there are variances, found " +
                                    std::to_string(space.kept()));
  for (Eigen::Index i = 0; i < space.components.cols(); ++i)
    if (!(std::abs(space.components.col(i).norm() - 1) < unit_tolerance))
      fail(field + ".components", "columns of length 1, found another");
  expect_values(space.variances, space.variances.size(), 1, field + ".variances");
  for (Eigen::Index i = 0; i < space.variances.size(); ++i)
    if (space.variances[i] < 0 || (i > 0 && space.variances[i] > space.variances[i - 1]))
      fail(field + ".variances", "numbers not below zero, descending");
}

void check_variation(const Variation& variation, const std::string& field) {
  expect_number(variation.mean, field + ".mean");
  expect_within(variation.deviation, 0, largest_number, field + ".deviation");
  expect_within(variation.largest_change, 0, largest_number, field + ".largest_change");
  expect_number(variation.lowest, field + ".lowest");
  expect_within(variation.highest, variation.lowest, largest_number, field + ".highest");
}

void check_style(const StyleCycles& style, int components, const std::string& field) {
  if (style.cycles < 0) fail(field + ".cycles", "0 or more");
  if (static_cast<int>(style.scores.size()) != components)
    fail(field + ".scores",
         std::to_string(components) + " components, found " + std::to_string(style.scores.size()));
  for (std::size_t i = 0; i < style.scores.size(); ++i)
    check_variation(style.scores[i], item(field + ".scores", i));
  check_variation(style.duration, field + ".duration");
  expect_values(style.correlation, components + 1, components + 1, field + ".correlation");
  const Eigen::Index size = components + 1;
  if (!(style.correlation.array().abs() <= 1 + unit_tolerance).all() ||
      !((style.correlation.diagonal().array() - 1).abs() <= unit_tolerance).all() ||
      Eigen::LLT<Eigen::MatrixXd>(style.correlation + unit_tolerance * static_cast<double>(size) *
                                                          Eigen::MatrixXd::Identity(size, size))
              .info() != Eigen::Success)
    fail(field + ".correlation", "correlations: 1 in the diagonal and positive semidefinite");
  expect_values(style.projected, components, style.cycles, field + ".projected");
  expect_values(style.durations, style.cycles, 1, field + ".durations");
  if (style.cycles == 0) return;
  expect_within(style.duration.lowest, 1e-3, longest_cycle, field + ".duration.lowest");
  expect_within(style.duration.highest, 1e-3, longest_cycle, field + ".duration.highest");
  expect_within(style.duration.mean, style.duration.lowest, style.duration.highest,
                field + ".duration.mean");
}

void check_style_space(const StyleSpace& space, const Model& model) {
  check_space(space.space, *model.body, "style_space.space");
  if (space.cycles_per_style < 1) fail("style_space.cycles_per_style", "1 or more");
  if (space.styles.size() != model.styles.size())
    fail("style_space.styles", std::to_string(model.styles.size()) + ", as the model has, found " +
                                   std::to_string(space.styles.size()));
  for (std::size_t i = 0; i < space.styles.size(); ++i)
    check_style(space.styles[i], space.space.kept(), item("style_space.styles", i));
  if (std::ranges::all_of(space.styles, [](const StyleCycles& style) { return style.cycles == 0; }))
    fail("style_space.styles", "at least one with cycles, found none");
}

void check_speed_space(const SpeedSpace& space, const Model& model, const std::string& field) {
  expect_within(space.leg_length, 1e-3, longest_leg, field + ".leg_length");
  check_space(space.space, *model.body, field + ".space");
  if (space.cycles < 1) fail(field + ".cycles", "1 or more");
  const int components = space.space.kept();
  expect_values(space.intercept, components, 1, field + ".intercept");
  expect_values(space.slope, components, 1, field + ".slope");
  expect_values(space.standing, components, 1, field + ".standing");
  expect_within(space.slowest, 0, fastest_walk, field + ".slowest");
  expect_within(space.fastest, space.slowest, fastest_walk, field + ".fastest");
  expect_values(space.speeds, space.cycles, 1, field + ".speeds");
  expect_values(space.frequencies, space.cycles, 1, field + ".frequencies");
  expect_values(space.projected, components, space.cycles, field + ".projected");
  expect_within(space.frequency_scale, 0, 1000, field + ".frequency_scale");
  expect_within(space.frequency_power, -10, 10, field + ".frequency_power");
  if (space.shared.intercept.size() == 0) return;
  if (!model.shared_speed_space) fail(field + ".shared", "a shared_speed_space beside it");
  const int shared = model.shared_speed_space->kept();
  expect_values(space.shared.intercept, shared, 1, field + ".shared.intercept");
  expect_values(space.shared.slope, shared, 1, field + ".shared.slope");
  expect_values(space.shared.standing, shared, 1, field + ".shared.standing");
  expect_values(space.shared.projected, shared, space.cycles, field + ".shared.projected");
}

}  // namespace

void check_cycle_spaces(const Model& model) {
  if (!model.style_space && model.speed_spaces.empty() && !model.shared_speed_space) return;
  if (!model.body) fail("body", "this field, as cycle spaces need it, found none");
  if (model.shared_speed_space)
    check_space(*model.shared_speed_space, *model.body, "shared_speed_space");
  if (model.style_space) check_style_space(*model.style_space, model);
  std::vector<std::string> subjects;
  for (std::size_t i = 0; i < model.speed_spaces.size(); ++i) {
    subjects.push_back(model.speed_spaces[i].subject);
    check_speed_space(model.speed_spaces[i], model, item("speed_spaces", i));
  }
  expect_names(subjects, "speed_spaces");
}

}  // namespace gait
