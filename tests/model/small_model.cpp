#include "small_model.h"

#include <cmath>
#include <numbers>
#include <random>

#include "gait/learn/trainer.h"
#include "gait/motion/rotation.h"

namespace gait::testing {

namespace {

// Two steps a second at 30 frames a second, ten of them: streams as sinusoids of the cycle, with
// some noise; the second style swings wider and faster.
Sequence take(int style, std::mt19937& random) {
  constexpr int step = 15, steps = 10;
  std::normal_distribution<double> noise(0, 0.02);
  Sequence sequence;
  sequence.name = "take_" + std::to_string(style);
  sequence.style = style;
  const int length = style == 0 ? step : step - 2;
  const int frames = (steps + 2) * length;
  sequence.inputs.resize(8, frames);
  sequence.outputs.resize(4, frames);
  for (int frame = 0; frame < frames; ++frame) {
    const double phase = std::numbers::pi * frame / length, swing = 0.4 + 0.2 * style;
    for (int i = 0; i < 8; ++i)
      sequence.inputs(i, frame) = swing * std::sin(phase + 0.7 * i) + noise(random);
    for (int i = 0; i < 4; ++i)
      sequence.outputs(i, frame) = swing * std::cos(phase + 0.4 * i) + noise(random);
    sequence.inputs(4, frame) = 0.25;  // a joint that never moves about this axis
  }
  for (int i = 0; i < steps; ++i)
    sequence.segments.push_back({(i + 1) * length, (i + 2) * length, i % 2});
  return sequence;
}

Body small_body() {
  Body body;
  body.skeleton.joints = {{"Hips", -1, {0, 0.9, 0}, {}},
                          {"Spine", 0, {0, 0.1, -0.01}, {}},
                          {"Head", 1, {0, 0.5, 0.02}, {{0, 0.2, 0}, {0, 0.1, 0.1}}},
                          {"LeftUpLeg", 0, {0.1, -0.05, 0}, {{0, -0.8, 0}}}};
  body.roles = {Role::hips, Role::spine, Role::head, Role::left_thigh};
  for (int i = 0; i < 4; ++i)
    body.references.push_back(exponential_map<double>({0.1 * i, -0.3, 0.2 * i}).normalized());
  body.input_joints = {2, 1};
  body.output_joints = {3};
  body.heading_window = 1.07;
  body.hips_frame = 0.06;
  body.hinges = {{0, 1, 2, Eigen::Vector3d(0.6, 0, 0.8), -0.1, 1.3}};
  return body;
}

Eigen::MatrixXd random_covariance(int size, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd factor =
      Eigen::MatrixXd::NullaryExpr(size, size, [&] { return normal(random); });
  Eigen::MatrixXd covariance = 0.1 * Eigen::MatrixXd::Identity(size, size);
  covariance.selfadjointView<Eigen::Lower>().rankUpdate(factor, 1.0 / size);
  covariance.triangularView<Eigen::StrictlyUpper>() = covariance.transpose();
  return covariance;
}

}  // namespace

Model learnt_model() {
  std::mt19937 random(7);
  LearningTask task;
  task.frame_rate = 29.97;  // where seconds and frames do not agree in round numbers
  task.inputs = {{"Head", 3, StreamKind::rotation},
                 {"Spine", 3, StreamKind::rotation},
                 {"hand height", 2, StreamKind::plain}};
  task.outputs = {{"LeftUpLeg", 3, StreamKind::rotation}, {"brightness", 1, StreamKind::plain}};
  task.labels = {{"right", {1}}, {"left", {0}}};
  task.styles = {"sad", "müde"};
  for (int i = 0; i < 4; ++i) task.sequences.push_back(take(i % 2, random));
  LearningOptions options;
  options.states = 2;
  options.history = {1.0 / 30, 4.0 / 30};
  options.hmm.soft_iterations = 3;
  options.hmm.threads = 1;
  Model model = learn(task, options).model;
  model.name = "sinusoids";
  model.body = small_body();
  model.input.clip = 9.5;
  model.play = {DecoderKind::lag, 0.2, 0.3, 0.7, 0.1, 2.2, 1.5, 1.7, 0.8, 0.03};
  model.training.subjects = {"anna", "bert"};
  model.training.placement = 0.01;
  model.training.strangers_error = 0.09;
  model.training.strangers_step_accuracy = 0.8;
  model.training.date = "2024-02-29";
  model.training.comment = "sinusoids with noise";
  model.training.regularisation_chosen_by = "hand";
  model.training.validated_error = 0.07;
  model.training.validated_step_accuracy = 0.9;
  model.training.validated_style_accuracy = 1.0 / 3;
  model.training.validated_calibration_error = 0.05;
  model.training.synthetic = true;
  return model;
}

Model large_model() {
  constexpr int inputs = 36, outputs = 27, styles = 15, states = 12;
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const auto noise = [&] { return normal(random); };
  Model model;
  const auto layout = [](int values, auto& of) {
    of.values = values;
    for (int i = 0; i < values; ++i) of.modelled.push_back(i);
  };
  layout(inputs, model.input);
  layout(outputs, model.output);
  model.input.lags = {1, 5, 10};
  for (int i = 0; i < inputs / 3; ++i) model.inputs.push_back({"in" + std::to_string(i)});
  for (int i = 0; i < outputs / 3; ++i) model.outputs.push_back({"out" + std::to_string(i)});
  const int x = model.input.size(), z = x + model.output.size();
  model.input_scaling = {Eigen::VectorXd::Zero(x), Eigen::VectorXd::Ones(x)};
  model.output_scaling = {Eigen::VectorXd::Zero(z - x), Eigen::VectorXd::Ones(z - x)};
  model.output_mean = Eigen::VectorXd::Zero(outputs);
  for (int i = 0; i < styles; ++i) model.styles.push_back("style" + std::to_string(i));
  for (int i = 0; i < 2; ++i) {
    Label label{i == 0 ? "right" : "left", {1 - i}, {}, 0.5, 0.05, 0.4, 0.7};
    for (int k = 0; k < states; ++k) {
      State state;
      state.mean = Eigen::VectorXd::NullaryExpr(z, noise);
      state.covariance = random_covariance(z, random);
      state.style_means = Eigen::MatrixXd::NullaryExpr(z, styles, noise);
      state.style_covariance = random_covariance(x, random);
      label.states.push_back(std::move(state));
    }
    model.labels.push_back(std::move(label));
  }
  return model;
}

}  // namespace gait::testing
