#include "gait/play/recognise/state_tables.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "gait/error.h"
#include "play/random_model.h"

namespace gait {
namespace {

using testing::entries_there;
using testing::random_model;
using testing::state_of;

TEST(StateTables, keep_the_entries_of_inputs_that_are_there) {
  const Model model = random_model();  // 5 values, 2 differences each
  const auto tables = make_state_tables(model, {false, true, false, false, true});
  EXPECT_EQ(tables->kept, (std::vector<int>{0, 2, 3, 5, 7, 8, 10, 12, 13}));
  EXPECT_EQ(tables->depths, (std::vector<int>{3, 6, 9}));
  EXPECT_EQ(tables->depth_of(0, model.input), 0);
  EXPECT_EQ(tables->depth_of(5, model.input), 0);
  EXPECT_EQ(tables->depth_of(10, model.input), 1);
  EXPECT_EQ(tables->depth_of(15, model.input), 2);
}

TEST(StateTables, hold_labels_durations_and_transitions_as_the_model_says) {
  const Model model = random_model({.states = {3, 1, 2}});
  const auto tables = make_state_tables(model);
  EXPECT_EQ(tables->first_state, (std::vector<int>{0, 3, 4}));
  EXPECT_EQ(tables->successors, (std::vector<std::vector<int>>{{1}, {2}, {0}}));
  for (int label = 0; label < 3; ++label) {
    double before = 0;
    for (std::size_t k = 0; k < model.labels[label].states.size(); ++k) {
      const PlayedState& played = tables->states[tables->first_state[label] + k];
      const State& state = model.labels[label].states[k];
      EXPECT_EQ(played.label, label);
      EXPECT_NEAR(played.before, before, 1e-6);
      EXPECT_NEAR(std::exp(played.log_stay), state.stay, 1e-6);
      EXPECT_NEAR(std::exp(played.log_leave), 1 - state.stay, 1e-6);
      before += state.duration;
    }
    EXPECT_NEAR(tables->label_duration[label], before, 1e-6);
  }
}

TEST(StateTables, explained_variance_is_that_of_the_regression_at_every_stage) {
  const Model model = random_model();
  const std::vector<bool> missing{false, false, true, false, false};
  const auto tables = make_state_tables(model, missing);
  const int x = model.input.size();
  for (int index = 0; index < model.states(); ++index)
    for (std::size_t depth = 0; depth < tables->depths.size(); ++depth) {
      const int known = model.input.statics() * (static_cast<int>(depth) + 1);
      const auto there = entries_there(model, known, missing);
      const State& state = state_of(model, index);
      std::vector<int> outputs;
      for (int i = 0; i < model.output.size(); ++i) outputs.push_back(x + i);
      const Eigen::MatrixXd cross = state.covariance(outputs, there);
      const Eigen::MatrixXd direct =
          cross * Eigen::MatrixXd(state.covariance(there, there)).inverse() * cross.transpose();
      const Eigen::VectorXf said =
          tables->states[index].explained_variance.col(static_cast<Eigen::Index>(depth));
      EXPECT_LT((said.cast<double>() - direct.diagonal()).cwiseAbs().maxCoeff(), 1e-5);
    }
}

TEST(StateTables, with_nothing_left_to_see_or_no_covariance_are_an_error) {
  Model model = random_model();
  EXPECT_THROW(make_state_tables(model, std::vector<bool>(5, true)), Error);
  Model broken = model;
  broken.labels[0].states[1].covariance.row(2).setZero();
  broken.labels[0].states[1].covariance.col(2).setZero();
  EXPECT_THROW(make_state_tables(broken), Error);
  broken = model;
  broken.labels[1].states[0].style_covariance *= -1;
  EXPECT_THROW(make_state_tables(broken), Error);
}

}  // namespace
}  // namespace gait
