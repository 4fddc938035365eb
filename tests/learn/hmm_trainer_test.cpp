#include "gait/learn/hmm_trainer.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "gait/error.h"
#include "gait/learn/observed.h"
#include "learn/random_sequences.h"
#include "play/few_walks.h"

namespace gait {
namespace {

using testing::random_sequence;
using testing::random_sequences;

// Rounding of a sum of many terms, not a fall.
void expect_never_falls(const TrainedStates& trained, const std::string& what) {
  const auto& penalised = trained.penalised_log_likelihood;
  for (std::size_t i = 1; i < penalised.size(); ++i)
    EXPECT_GE(penalised[i], penalised[i - 1] - 1e-6 * (1 + std::abs(penalised[i - 1])))
        << what << ", round " << i;
}

HmmOptions many_rounds(double kappa) {
  HmmOptions options;
  options.regularisation = kappa;
  options.soft_iterations = 12;
  options.enough = -1e9;  // never stop early
  options.threads = 1;
  return options;
}

TEST(HmmTrainer, the_penalised_likelihood_never_falls) {
  for (const double kappa : {1.0, 3.0, 30.0, 300.0})
    for (const unsigned seed : {1u, 2u, 3u})
      for (const int slack : {0, 2, 4}) {
        const auto sequences = random_sequences(5, 6, 6, 3, seed);
        HmmOptions options = many_rounds(kappa);
        options.slack = slack;
        const TrainedStates trained = train_states(sequences, StateTable({3, 4}), 2, options);
        ASSERT_EQ(trained.penalised_log_likelihood.size(), 12u);
        ASSERT_EQ(trained.log_likelihood.size(), 12u);
        expect_never_falls(trained, "kappa " + std::to_string(kappa) + " seed " +
                                        std::to_string(seed) + " slack " + std::to_string(slack));
        EXPECT_GT(trained.penalised_log_likelihood.back(), trained.penalised_log_likelihood[0]);
      }
}

TEST(HmmTrainer, nor_does_it_fall_when_segments_are_too_short_for_their_states) {
  for (const double kappa : {3.0, 100.0}) {
    auto sequences = random_sequences(4, 5, 4, 2, 9);
    // Shorter than four states each, even with the slack: it keeps equal parts.
    sequences.push_back(random_sequence({2, 2, 2, 2}, 2, 4, 2, 77));
    expect_never_falls(train_states(sequences, StateTable({4, 4}), 2, many_rounds(kappa)), "short");
  }
}

TEST(HmmTrainer, nor_on_walks) {
  const ObservationSet observed = observe(testing::few_sequences().sequences, {1, 5});
  HmmOptions options = many_rounds(30);
  options.soft_iterations = 6;
  const TrainedStates trained = train_states(observed.sequences, StateTable({4, 4}), 4, options);
  expect_never_falls(trained, "walks");
}

TEST(HmmTrainer, gives_the_same_for_any_number_of_threads) {
  const auto sequences = random_sequences(5, 6, 5, 3, 4);
  HmmOptions options = many_rounds(10);
  options.hard_iterations = 2;
  options.soft_iterations = 3;
  const TrainedStates one = train_states(sequences, StateTable({3, 3}), 2, options);
  for (const int threads : {2, 3}) {
    options.threads = threads;
    const TrainedStates many = train_states(sequences, StateTable({3, 3}), 2, options);
    EXPECT_EQ(one.penalised_log_likelihood, many.penalised_log_likelihood);
    EXPECT_EQ(one.stay, many.stay);
    for (std::size_t state = 0; state < one.statistics.size(); ++state)
      EXPECT_EQ(one.statistics[state].products, many.statistics[state].products);
  }
}

TEST(HmmTrainer, without_rounds_states_share_a_segment_evenly) {
  const auto sequences = random_sequences(3, 4, 3, 2, 5);
  HmmOptions options;
  options.threads = 1;
  const TrainedStates trained = train_states(sequences, StateTable({2, 3}), 2, options);
  double frames = 0;
  for (const StateStatistics& state : trained.statistics) frames += state.count;
  double expected = 0;
  for (const auto& sequence : sequences)
    expected += sequence.segments.back().end - sequence.segments.front().begin;
  EXPECT_EQ(frames, expected) << "frames outside the segments are not used";
  EXPECT_TRUE(trained.log_likelihood.empty());
  // T is the diagonal of the pooled covariance within the states.
  Eigen::VectorXd pooled = Eigen::VectorXd::Zero(5);
  for (const StateStatistics& state : trained.statistics)
    pooled += state.count * state.covariance().diagonal();
  EXPECT_TRUE(trained.target.isApprox(pooled / frames, 1e-9));
}

TEST(HmmTrainer, a_regularised_covariance_lies_between_the_data_and_the_target) {
  const Eigen::MatrixXd data = (Eigen::MatrixXd(2, 2) << 4, 3.9, 3.9, 4).finished();
  const Eigen::VectorXd target = Eigen::Vector2d(1, 2);
  EXPECT_TRUE(regularised(data, 50, target, 0).isApprox(data));
  EXPECT_TRUE(regularised(data, 0, target, 30).isApprox(Eigen::MatrixXd(target.asDiagonal())));
  const Eigen::MatrixXd half = regularised(data, 30, target, 30);
  EXPECT_TRUE(half.isApprox((Eigen::MatrixXd(2, 2) << 2.5, 1.95, 1.95, 3).finished()));
}

TEST(HmmTrainer, more_regularisation_keeps_covariances_of_little_data_invertible) {
  // Fewer frames per state than dimensions.
  const auto sequences = random_sequences(1, 2, 20, 2, 6);
  HmmOptions options;
  options.threads = 1;
  const TrainedStates trained = train_states(sequences, StateTable({2, 2}), 2, options);
  for (const StateStatistics& state : trained.statistics) {
    const auto smallest = [&](double kappa) {
      return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                 regularised(state.covariance(), state.count, trained.target, kappa))
          .eigenvalues()[0];
    };
    EXPECT_LT(smallest(0), 1e-9);
    EXPECT_GT(smallest(3), 1e-3);
    EXPECT_GT(smallest(30), smallest(3));
  }
}

TEST(HmmTrainer, a_state_without_frames_is_an_error_that_says_what_to_do) {
  const std::vector<ObservedSequence> sequences{random_sequence({3, 3}, 2, 2, 1, 1)};
  try {
    train_states(sequences, StateTable({5, 5}), 0, {});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("fewer states"), std::string::npos);
  }
}

TEST(HmmTrainer, reports_progress_and_can_be_cancelled) {
  const auto sequences = random_sequences(3, 4, 3, 2, 8);
  HmmOptions options = many_rounds(10);
  double before = -1;
  int reports = 0;
  Cancel source;
  options.progress = [&](double share, const std::string& what) {
    EXPECT_GT(share, before);
    EXPECT_LE(share, 1);
    EXPECT_FALSE(what.empty());
    before = share;
    if (++reports == 4) source.request();
  };
  options.cancel = source;
  try {
    train_states(sequences, StateTable({2, 2}), 2, options);
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "cancelled");
  }
  EXPECT_EQ(reports, 4);
}

TEST(HmmTrainer, stops_when_there_is_little_left_to_gain) {
  const auto sequences = random_sequences(3, 4, 3, 2, 8);
  HmmOptions options = many_rounds(10);
  options.soft_iterations = 200;
  options.enough = 1e-3;
  const TrainedStates trained = train_states(sequences, StateTable({2, 2}), 2, options);
  EXPECT_LT(trained.log_likelihood.size(), 100u);
  EXPECT_GT(trained.log_likelihood.size(), 1u);
}

}  // namespace
}  // namespace gait
