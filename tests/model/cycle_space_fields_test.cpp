// Cycle spaces in a model file: kept to the bit, and refused by name when nobody could walk in
// them.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "gait/error.h"
#include "gait/model/model_file.h"
#include "same_model.h"
#include "small_model.h"

namespace gait {
namespace {

CycleSpace space_of(int kept) {
  CycleSpace space;
  space.frames = 4;
  space.joints = {1, 3};
  space.mean = Eigen::VectorXd::LinSpaced(space.values(), -0.3, 1.0 / 3);
  space.components = Eigen::MatrixXd::Identity(space.values(), kept);
  space.variances = Eigen::VectorXd::LinSpaced(9, 2, 0.01);
  return space;
}

// A space for both of the model's styles, and two subjects, one of them in a shared space too.
Model model_with_spaces() {
  static const Model learnt = testing::learnt_model();
  Model model = learnt;
  StyleSpace styles{space_of(3), 5, {}};
  for (int i = 0; i < 2; ++i) {
    StyleCycles style;
    style.cycles = 5 + i;
    for (int k = 0; k < 3; ++k) style.scores.push_back({0.1 * k, 0.2, 0.3, -0.5, 0.6});
    style.duration = {1.1, 0.05, 0.1, 1.0, 1.2};
    style.correlation = Eigen::MatrixXd::Identity(4, 4);
    style.correlation(1, 0) = style.correlation(0, 1) = 1.0 / 3;
    style.projected = Eigen::MatrixXd::Constant(3, style.cycles, 0.25);
    style.durations = Eigen::VectorXd::LinSpaced(style.cycles, 1.0, 1.2);
    styles.styles.push_back(style);
  }
  model.style_space = styles;
  model.shared_speed_space = space_of(4);
  for (const char* subject : {"08", "16"}) {
    SpeedSpace speed;
    speed.subject = subject;
    speed.leg_length = 0.87;
    speed.space = space_of(2);
    speed.cycles = 12;
    speed.intercept = Eigen::Vector2d(0.1, -0.2);
    speed.slope = Eigen::Vector2d(1.5, 1.0 / 7);
    speed.standing = Eigen::Vector2d(-1, 0.3);
    speed.slowest = 0.9, speed.fastest = 2.3;
    speed.speeds = Eigen::VectorXd::LinSpaced(12, 0.9, 2.3);
    speed.frequencies = Eigen::VectorXd::LinSpaced(12, 0.7, 1.1);
    speed.projected = Eigen::MatrixXd::Constant(2, 12, 1.0 / 3);
    speed.frequency_scale = 0.75, speed.frequency_power = 0.41;
    model.speed_spaces.push_back(speed);
  }
  model.speed_spaces[1].shared = {Eigen::Vector4d::Ones(), Eigen::Vector4d::Zero(),
                                  Eigen::Vector4d::Constant(0.2),
                                  Eigen::MatrixXd::Constant(4, 12, 0.1)};
  return model;
}

std::string said_of(const std::function<void(Model&)>& bend) {
  Model model = model_with_spaces();
  bend(model);
  try {
    check_model(model);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(CycleSpaceFields, are_the_same_to_the_bit_after_writing_and_reading) {
  const Model model = model_with_spaces();
  testing::expect_same(model, parse_model(model_bytes(model), "small"));
}

TEST(CycleSpaceFields, that_nobody_could_walk_in_are_named) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::function<void(Model&)>>> bends{
      {"body", [](Model& m) { m.body.reset(); }},
      {"style_space.space.frames", [](Model& m) { m.style_space->space.frames = 3; }},
      {"style_space.space.joints",
       [](Model& m) {
         m.style_space->space.joints = {3, 1};
       }},
      {"style_space.space.joints",
       [](Model& m) {
         m.style_space->space.joints = {1, 77};
       }},
      {"style_space.space.mean", [](Model& m) { m.style_space->space.mean.conservativeResize(5); }},
      {"style_space.space.mean", [&](Model& m) { m.style_space->space.mean[2] = nan; }},
      {"style_space.space.components", [](Model& m) { m.style_space->space.components *= 2; }},
      {"style_space.space.variances", [](Model& m) { m.style_space->space.variances[3] = 9; }},
      {"style_space.styles", [](Model& m) { m.style_space->styles.pop_back(); }},
      {"style_space.styles[1].scores",
       [](Model& m) { m.style_space->styles[1].scores.pop_back(); }},
      {"style_space.styles[0].scores[2].deviation",
       [](Model& m) { m.style_space->styles[0].scores[2].deviation = -1; }},
      {"style_space.styles[0].duration.lowest",
       [](Model& m) { m.style_space->styles[0].duration.lowest = 0; }},
      {"style_space.styles[1].correlation",
       [](Model& m) { m.style_space->styles[1].correlation(1, 0) = 2; }},
      {"style_space.styles[1].correlation",
       [](Model& m) {
         Eigen::MatrixXd& correlation = m.style_space->styles[1].correlation;
         correlation(1, 0) = correlation(0, 1) = correlation(2, 0) = correlation(0, 2) = 0.9;
         correlation(2, 1) = correlation(1, 2) = -0.9;
       }},
      {"style_space.styles[0].projected",
       [](Model& m) { m.style_space->styles[0].projected.resize(2, 5); }},
      {"style_space.styles[1].durations",
       [](Model& m) { m.style_space->styles[1].durations.resize(2); }},
      {"speed_spaces[0].speeds", [](Model& m) { m.speed_spaces[0].speeds.resize(3); }},
      {"speed_spaces[1].frequencies", [&](Model& m) { m.speed_spaces[1].frequencies[2] = nan; }},
      {"speed_spaces[0].projected", [](Model& m) { m.speed_spaces[0].projected.resize(3, 12); }},
      {"speed_spaces[1].shared.projected",
       [](Model& m) { m.speed_spaces[1].shared.projected.resize(4, 3); }},
      {"speed_spaces[1].leg_length", [](Model& m) { m.speed_spaces[1].leg_length = 0; }},
      {"speed_spaces[0].slope", [](Model& m) { m.speed_spaces[0].slope.resize(5); }},
      {"speed_spaces[0].fastest", [](Model& m) { m.speed_spaces[0].fastest = 0.1; }},
      {"speed_spaces[1]", [](Model& m) { m.speed_spaces[1].subject = "08"; }},
      {"speed_spaces[1].shared", [](Model& m) { m.shared_speed_space.reset(); }}};
  for (const auto& [field, bend] : bends) {
    const std::string said = said_of(bend);
    EXPECT_EQ(said.substr(0, field.size()), field) << said;
  }
  EXPECT_EQ(said_of([](Model&) {}), "");
}

}  // namespace
}  // namespace gait
