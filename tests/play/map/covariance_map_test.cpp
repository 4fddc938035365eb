// Mapping against K = Sigma_yx Sigma_xx^-1, written out in double.
#include "gait/play/map/covariance_map.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "play/random_model.h"

namespace gait {
namespace {

using testing::entries_there;
using testing::random_model;
using testing::random_vector;
using testing::state_of;

struct Mapped {
  Eigen::VectorXd mean, variance;  // scaled
};

// One state, strength per output entry.
Mapped mapped_directly(const Model& model, const State& state, const Eigen::VectorXf& x,
                       const std::vector<int>& there, const Eigen::VectorXd& strength) {
  const int inputs = model.input.size(), outputs = model.output.size();
  std::vector<int> y;
  for (int i = 0; i < outputs; ++i) y.push_back(inputs + i);
  const Eigen::MatrixXd cross = state.covariance(y, there);
  const Eigen::MatrixXd gain = cross * Eigen::MatrixXd(state.covariance(there, there)).inverse();
  const Eigen::VectorXd from_mean = x.cast<double>()(there) - state.mean(there);
  Mapped mapped;
  mapped.mean = state.mean(y) + strength.cwiseProduct(gain * from_mean);
  const Eigen::VectorXd explained = (gain * cross.transpose()).diagonal();
  mapped.variance = state.covariance.diagonal()(y).array() -
                    strength.array() * (2 - strength.array()) * explained.array();
  return mapped;
}

void expect_mapped(const Model& model, const OutputGaussian& said, const Mapped& expected) {
  const Eigen::VectorXd& scale = model.output_scaling.deviation;
  const Eigen::VectorXd mean = scale.cwiseProduct(expected.mean) + model.output_scaling.mean;
  const Eigen::VectorXd variance = scale.cwiseAbs2().cwiseProduct(expected.variance.cwiseMax(1e-6));
  EXPECT_LT((said.mean.cast<double>() - mean).cwiseAbs().maxCoeff(), 2e-4);
  // Relative: a tight variance weighs most in the trajectory.
  EXPECT_LT((said.variance.cast<double>() - variance).cwiseQuotient(variance).cwiseAbs().maxCoeff(),
            1e-3);
}

TEST(CovarianceMap, is_the_conditional_gaussian_of_each_state) {
  const Model model = random_model();
  CovarianceMap map(model, make_state_tables(model));
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(model.output.size());
  for (unsigned seed = 0; seed < 5; ++seed)
    for (int index = 0; index < model.states(); ++index) {
      const Eigen::VectorXf x = random_vector(model.input.size(), seed);
      const WeightedState state{index, 1};
      const auto there = entries_there(model, model.input.size());
      expect_mapped(model, map.map({&state, 1}, x, model.input.size()),
                    mapped_directly(model, state_of(model, index), x, there, one));
    }
}

TEST(CovarianceMap, with_no_strength_gives_the_states_own_means_and_variances) {
  const Model model = random_model();
  CovarianceMap map(model, make_state_tables(model));
  map.set_strength(0);
  for (int index = 0; index < model.states(); ++index) {
    const WeightedState state{index, 1};
    const State& learnt = state_of(model, index);
    const Eigen::VectorXd mean =
        model.output_scaling.deviation.cwiseProduct(learnt.mean.tail(model.output.size())) +
        model.output_scaling.mean;
    const OutputGaussian& said =
        map.map({&state, 1}, random_vector(model.input.size(), 3, 5), model.input.size());
    EXPECT_LT((said.mean.cast<double>() - mean).cwiseAbs().maxCoeff(), 1e-6);
    const Eigen::VectorXd variance = model.output_scaling.deviation.cwiseAbs2().cwiseProduct(
        learnt.covariance.diagonal().tail(model.output.size()));
    EXPECT_LT((said.variance.cast<double>() - variance).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST(CovarianceMap, caricatures_above_strength_one_and_value_by_value) {
  const Model model = random_model();
  CovarianceMap map(model, make_state_tables(model));
  map.set_strength(1.6f);
  map.set_strength(2, 0.3f);
  EXPECT_FLOAT_EQ(map.strength(0), 1.6f);
  Eigen::VectorXd strength = Eigen::VectorXd::Constant(model.output.size(), 1.6);
  for (int part = 0; part < 3; ++part) strength[part * model.output.statics() + 2] = 0.3;
  const WeightedState state{4, 1};
  const Eigen::VectorXf x = random_vector(model.input.size(), 2);
  expect_mapped(model, map.map({&state, 1}, x, model.input.size()),
                mapped_directly(model, state_of(model, 4), x,
                                entries_there(model, model.input.size()), strength));
}

TEST(CovarianceMap, of_several_states_gives_the_moments_of_their_mixture) {
  const Model model = random_model();
  CovarianceMap map(model, make_state_tables(model));
  const std::vector<WeightedState> states{{3, 0.6f}, {0, 0.3f}, {4, 0.1f}};
  const Eigen::VectorXf x = random_vector(model.input.size(), 6);
  const auto there = entries_there(model, model.input.size());
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(model.output.size());
  Mapped mixture{Eigen::VectorXd::Zero(model.output.size()),
                 Eigen::VectorXd::Zero(model.output.size())};
  for (const WeightedState& state : states) {
    const Mapped part = mapped_directly(model, state_of(model, state.state), x, there, one);
    mixture.mean += state.weight * part.mean;
  }
  for (const WeightedState& state : states) {
    const Mapped part = mapped_directly(model, state_of(model, state.state), x, there, one);
    mixture.variance += state.weight * (part.variance + (part.mean - mixture.mean).cwiseAbs2());
  }
  expect_mapped(model, map.map(states, x, model.input.size()), mixture);
}

TEST(CovarianceMap, trusts_an_observation_less_the_further_it_is_from_what_was_taught) {
  Model model = random_model();
  model.play.trust = 1.5;
  model.play.usual_distance = 0.8;
  CovarianceMap map(model, make_state_tables(model));
  const WeightedState state{0, 1};
  const auto there = entries_there(model, model.input.size());
  const Eigen::VectorXf mean = state_of(model, 0).mean.head(model.input.size()).cast<float>();
  const Eigen::VectorXf away = random_vector(model.input.size(), 3);
  for (const float far : {0.1f, 1.0f, 3.0f, 10.0f, 1000.0f}) {
    const Eigen::VectorXf x = mean + far * away;
    const OutputGaussian mapped = map.map({&state, 1}, x, model.input.size());
    const double trust = std::pow(std::min(1.0, 1.5 * 0.8 / map.distance()), 2);
    const Eigen::VectorXd strength = Eigen::VectorXd::Constant(model.output.size(), trust);
    expect_mapped(model, mapped, mapped_directly(model, state_of(model, 0), x, there, strength));
    if (far > 5) {
      EXPECT_LT(trust, 0.2);
    }
  }
}

TEST(CovarianceMap, maps_what_is_clipped_and_says_how_far_it_was_before) {
  Model model = random_model();
  const Eigen::VectorXf x = 3 * random_vector(model.input.size(), 4);
  const WeightedState state{0, 1};
  CovarianceMap unclipped(model, make_state_tables(model));
  unclipped.map({&state, 1}, x, model.input.size());
  model.input.clip = 2;
  Eigen::VectorXf held = x;
  ASSERT_TRUE(clip_observation(model.input, model.input.size(), held));
  CovarianceMap map(model, make_state_tables(model));
  const OutputGaussian mapped = map.map({&state, 1}, x, model.input.size());
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(model.output.size());
  expect_mapped(model, mapped,
                mapped_directly(model, state_of(model, 0), held,
                                entries_there(model, model.input.size()), one));
  EXPECT_NEAR(map.distance(), unclipped.distance(), 1e-4 * unclipped.distance());
}

TEST(CovarianceMap, uses_what_is_known_and_there_and_nothing_else) {
  const Model model = random_model();
  const std::vector<bool> missing{false, false, false, true, false};
  CovarianceMap map(model, make_state_tables(model, missing));
  const WeightedState state{1, 1};
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(model.output.size());
  for (int past = 0; past <= 3; ++past) {
    const int known = model.input.known(past);
    Eigen::VectorXf x = random_vector(model.input.size(), 11);
    const Mapped expected =
        mapped_directly(model, state_of(model, 1), x, entries_there(model, known, missing), one);
    x.tail(model.input.size() - known).setConstant(50);
    x[3] = 99;
    expect_mapped(model, map.map({&state, 1}, x, known), expected);
  }
}

TEST(CovarianceMap, says_how_far_an_observation_is_from_what_was_taught) {
  const Model model = random_model();
  CovarianceMap map(model, make_state_tables(model));
  const State& taught = state_of(model, 2);
  const int inputs = model.input.size();
  const WeightedState state{2, 1};
  map.map({&state, 1}, taught.mean.head(inputs).cast<float>().eval(), inputs);
  EXPECT_NEAR(map.distance(), 0, 1e-5);
  // Drawn from the state's own Gaussian it is about one, whatever the covariance.
  const Eigen::MatrixXd root =
      Eigen::MatrixXd(taught.covariance.topLeftCorner(inputs, inputs)).llt().matrixL();
  double sum = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Eigen::VectorXd white = random_vector(inputs, seed).cast<double>();
    const Eigen::VectorXf x = (taught.mean.head(inputs) + root * white).cast<float>();
    map.map({&state, 1}, x, inputs);
    EXPECT_NEAR(map.distance(), white.norm() / std::sqrt(inputs), 1e-3);
    sum += map.distance();
  }
  EXPECT_NEAR(sum / 200, 1, 0.1);
}

}  // namespace
}  // namespace gait
