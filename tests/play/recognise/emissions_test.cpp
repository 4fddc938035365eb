// Emissions against log-likelihoods of marginals that Eigen computes in double.
#include "gait/play/recognise/emissions.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "play/random_model.h"

namespace gait {
namespace {

using testing::entries_there;
using testing::random_model;
using testing::random_vector;
using testing::state_of;

double log_likelihood(const State& state, const Eigen::VectorXf& x, const std::vector<int>& there) {
  const Eigen::MatrixXd covariance = state.covariance(there, there);
  const Eigen::VectorXd from_mean = x.cast<double>()(there) - state.mean(there);
  return -0.5 * (from_mean.dot(covariance.fullPivLu().solve(from_mean)) +
                 std::log(covariance.determinant()) +
                 static_cast<double>(there.size()) * std::log(2 * std::numbers::pi));
}

void expect_marginals(const Model& model, const std::vector<bool>& missing) {
  const auto tables = make_state_tables(model, missing);
  Emissions emissions(tables, model.input);
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Eigen::VectorXf x = random_vector(model.input.size(), seed, 2);
    for (int past = 0; past <= model.input.lags.back() + 1; ++past) {
      const int known = model.input.known(past);
      const auto said = emissions.of(x, known);
      ASSERT_EQ(static_cast<int>(said.size()), model.states());
      for (int state = 0; state < model.states(); ++state) {
        const double expected =
            log_likelihood(state_of(model, state), x, entries_there(model, known, missing));
        EXPECT_NEAR(said[state], expected, 1e-4 * (1 + std::abs(expected)))
            << "state " << state << " after " << past << " frames";
      }
    }
  }
}

TEST(Emissions, are_the_log_likelihoods_of_what_is_known_already) {
  expect_marginals(random_model(), {});
  // More entries than one panel of the packed triangle, and a number that does not fill the last.
  expect_marginals(random_model({.inputs = 11, .lags = {1, 2, 5}, .styles = 0, .seed = 4}), {});
}

TEST(Emissions, without_some_inputs_are_those_of_the_rest) {
  const Model model = random_model();
  expect_marginals(model, {false, true, false, false, false});
  expect_marginals(model, {true, false, false, true, true});
  expect_marginals(model, {false, true, true, true, true});
}

TEST(Emissions, do_not_look_at_what_is_missing_or_not_real_yet) {
  const Model model = random_model();
  Emissions emissions(make_state_tables(model, {false, false, true, false, false}), model.input);
  Eigen::VectorXf x = random_vector(model.input.size(), 1);
  const int known = model.input.known(0);
  const auto first = emissions.of(x, known);
  const std::vector<float> before(first.begin(), first.end());
  x.tail(model.input.size() - known).setConstant(123);
  x[2] = -77;
  const auto second = emissions.of(x, known);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(second[i], before[i]);
}

TEST(Emissions, a_change_of_tables_takes_effect_at_the_next_frame) {
  const Model model = random_model();
  const auto all = make_state_tables(model),
             some = make_state_tables(model, {true, false, false, false, false});
  Emissions changing(all, model.input), fixed(some, model.input);
  const Eigen::VectorXf x = random_vector(model.input.size(), 9);
  changing.of(x, model.input.size());
  changing.use(some);
  const auto a = changing.of(x, model.input.size()), b = fixed.of(x, model.input.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i], b[i]);
}

}  // namespace
}  // namespace gait
