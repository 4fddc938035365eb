#include "play/random_model.h"

namespace gait::testing {

Eigen::MatrixXd random_covariance(int size, std::mt19937& random) {
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd factor =
      Eigen::MatrixXd::NullaryExpr(size, size, [&] { return normal(random); });
  return factor * factor.transpose() / size + 0.2 * Eigen::MatrixXd::Identity(size, size);
}

Model random_model(const RandomModelPlan& plan) {
  std::mt19937 random(plan.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.3, 0.9);
  const auto noise = [&] { return normal(random); };
  const auto positive = [&] { return uniform(random); };
  Model model;
  model.name = "random";
  model.inputs = {{"in", plan.inputs, StreamKind::plain}};
  model.outputs = {{"out", plan.outputs, StreamKind::plain}};
  model.input = {plan.inputs, {}, plan.lags};
  model.output = {plan.outputs, {}};
  for (int i = 0; i < plan.inputs; ++i) model.input.modelled.push_back(i);
  for (int i = 0; i < plan.outputs; ++i) model.output.modelled.push_back(i);
  const int x = model.input.size(), y = model.output.size();
  model.input_scaling = {Eigen::VectorXd::NullaryExpr(x, noise),
                         Eigen::VectorXd::NullaryExpr(x, positive)};
  model.output_scaling = {Eigen::VectorXd::NullaryExpr(y, noise),
                          Eigen::VectorXd::NullaryExpr(y, positive)};
  model.output_mean = model.output_scaling.mean.head(plan.outputs);
  for (int i = 0; i < plan.styles; ++i) model.styles.push_back("style " + std::to_string(i));
  const int labels = static_cast<int>(plan.states.size());
  for (int i = 0; i < labels; ++i) {
    Label label;
    label.name = "label " + std::to_string(i);
    label.successors = {(i + 1) % labels};
    for (int k = 0; k < plan.states[i]; ++k) {
      State state;
      state.mean = Eigen::VectorXd::NullaryExpr(x + y, noise);
      state.covariance = random_covariance(x + y, random);
      state.stay = positive();
      state.duration = 1 / (1 - state.stay) / model.frame_rate;
      state.weight = 100;
      if (plan.styles > 0) {
        state.style_means = Eigen::MatrixXd::NullaryExpr(x + y, plan.styles, noise);
        state.style_covariance = random_covariance(x, random);
      }
      label.duration += state.duration;
      label.states.push_back(std::move(state));
    }
    label.shortest = label.duration / 2;
    label.longest = label.duration * 2;
    model.labels.push_back(std::move(label));
  }
  return model;
}

const State& state_of(const Model& model, int index) {
  for (const Label& label : model.labels) {
    if (index < static_cast<int>(label.states.size())) return label.states[index];
    index -= static_cast<int>(label.states.size());
  }
  return model.labels.front().states.front();
}

Eigen::VectorXf random_vector(int size, unsigned seed, double deviation) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal(0, static_cast<float>(deviation));
  return Eigen::VectorXf::NullaryExpr(size, [&] { return normal(random); });
}

std::vector<int> entries_there(const Model& model, int known, const std::vector<bool>& missing) {
  std::vector<int> entries;
  for (int entry = 0; entry < known; ++entry)
    if (missing.empty() || !missing[model.input.modelled[entry % model.input.statics()]])
      entries.push_back(entry);
  return entries;
}

}  // namespace gait::testing
