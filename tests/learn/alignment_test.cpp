// Alignment against every way there is to lay a row of states over a few frames.
#include "gait/learn/alignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "learn/random_sequences.h"

namespace gait {
namespace {

using testing::random_sequence;

EmissionModel random_emissions(int states, int inputs, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> stay(0.2, 0.9);
  EmissionModel model;
  for (int state = 0; state < states; ++state) {
    const Eigen::VectorXd mean =
        Eigen::VectorXd::NullaryExpr(inputs, [&] { return normal(random); });
    const Eigen::MatrixXd root =
        Eigen::MatrixXd::NullaryExpr(inputs, inputs, [&] { return normal(random); });
    model.of_state.emplace_back(
        mean, Eigen::MatrixXd(root * root.transpose() + Eigen::MatrixXd::Identity(inputs, inputs)));
    model.stay.push_back(stay(random));
  }
  return model;
}

struct Path {
  std::vector<int> states;  // per frame, over all labels
  std::vector<bool> moved;  // from the frame before
  double log_likelihood;
};

// Every path through the sequence's row of states within the slack.
std::vector<Path> every_path(const ObservedSequence& sequence, const StateTable& table,
                             const EmissionModel& model, int slack) {
  struct Place {
    int state, begin, end;
  };
  std::vector<Place> row;
  const int first = sequence.segments.front().begin, last = sequence.segments.back().end;
  for (const Segment& segment : sequence.segments)
    for (int k = 0; k < table.states[segment.label]; ++k)
      row.push_back(
          {table.first_state[segment.label] + k, segment.begin - slack, segment.end + slack});
  std::vector<Path> paths;
  Path path{{}, {}, 0};
  const std::function<void(int, std::size_t, bool, double)> extend =
      [&](int frame, std::size_t place, bool moved, double score) {
        if (place >= row.size() || frame < row[place].begin || frame >= row[place].end) return;
        const int state = row[place].state;
        score += model.of_state[state].log_likelihoods(sequence.x.col(frame))[0];
        path.states.push_back(state), path.moved.push_back(moved);
        if (frame + 1 == last) {
          if (place + 1 == row.size()) {
            path.log_likelihood = score;
            paths.push_back(path);
          }
        } else {
          extend(frame + 1, place, false, score + std::log(model.stay[state]));
          extend(frame + 1, place + 1, true, score + std::log(1 - model.stay[state]));
        }
        path.states.pop_back(), path.moved.pop_back();
      };
  extend(first, 0, false, 0);
  return paths;
}

struct Case {
  std::vector<int> lengths;
  std::vector<int> states;
  int slack;
};
const std::vector<Case> cases{{{4, 5}, {2, 2}, 1}, {{3, 3, 4}, {2, 1}, 2},
                              {{10}, {3, 1}, 0},   {{2, 6, 3}, {3, 2}, 1},
                              {{1, 9}, {3, 2}, 2}, {{4, 4, 4}, {1, 1}, 2}};

TEST(Alignment, posteriors_are_the_sum_over_every_path) {
  for (const Case& one : cases)
    for (unsigned seed = 0; seed < 4; ++seed) {
      const StateTable table(one.states);
      const ObservedSequence sequence = random_sequence(one.lengths, 2, 2, 1, seed, 2);
      const EmissionModel model = random_emissions(table.total, 2, seed + 50);
      const std::vector<Path> paths = every_path(sequence, table, model, one.slack);
      ASSERT_FALSE(paths.empty());
      double best = -std::numeric_limits<double>::infinity(), sum = 0;
      for (const Path& path : paths) best = std::max(best, path.log_likelihood);
      for (const Path& path : paths) sum += std::exp(path.log_likelihood - best);
      const double total = best + std::log(sum);

      std::map<std::pair<int, int>, double> shares;  // frame, state
      std::vector<double> stays(table.total), leaves(table.total);
      const int first = sequence.segments.front().begin;
      for (const Path& path : paths) {
        const double weight = std::exp(path.log_likelihood - total);
        for (std::size_t i = 0; i < path.states.size(); ++i) {
          shares[{first + static_cast<int>(i), path.states[i]}] += weight;
          if (i > 0) (path.moved[i] ? leaves : stays)[path.states[i - 1]] += weight;
        }
      }
      const Alignment aligned = align(sequence, table, model, one.slack, false);
      EXPECT_NEAR(aligned.log_likelihood, total, 1e-9 * std::abs(total));
      std::map<std::pair<int, int>, double> said;
      int frame_before = -1;
      for (const Occupancy& at : aligned.occupancies) {
        said[{at.frame, at.state}] += at.share;
        EXPECT_GE(at.frame, frame_before) << "frame after frame";
        frame_before = at.frame;
      }
      for (const auto& [where, share] : shares) EXPECT_NEAR(said[where], share, 2e-8);
      for (const auto& [where, share] : said) EXPECT_NEAR(shares[where], share, 2e-8);
      for (int state = 0; state < table.total; ++state) {
        EXPECT_NEAR(aligned.stays[state], stays[state], 1e-6);
        EXPECT_NEAR(aligned.leaves[state], leaves[state], 1e-6);
      }
    }
}

TEST(Alignment, the_hard_one_is_the_best_of_every_path) {
  for (const Case& one : cases)
    for (unsigned seed = 0; seed < 4; ++seed) {
      const StateTable table(one.states);
      const ObservedSequence sequence = random_sequence(one.lengths, 2, 2, 1, seed + 10, 1);
      const EmissionModel model = random_emissions(table.total, 2, seed + 70);
      const std::vector<Path> paths = every_path(sequence, table, model, one.slack);
      const Path& best = *std::max_element(
          paths.begin(), paths.end(),
          [](const Path& a, const Path& b) { return a.log_likelihood < b.log_likelihood; });
      const Alignment aligned = align(sequence, table, model, one.slack, true);
      EXPECT_NEAR(aligned.log_likelihood, best.log_likelihood, 1e-9);
      ASSERT_EQ(aligned.occupancies.size(), best.states.size());
      std::vector<double> stays(table.total), leaves(table.total);
      for (std::size_t i = 0; i < best.states.size(); ++i) {
        EXPECT_EQ(aligned.occupancies[i].state, best.states[i]);
        EXPECT_EQ(aligned.occupancies[i].frame,
                  sequence.segments.front().begin + static_cast<int>(i));
        EXPECT_EQ(aligned.occupancies[i].share, 1);
        if (i > 0) (best.moved[i] ? leaves : stays)[best.states[i - 1]] += 1;
      }
      EXPECT_EQ(aligned.stays, stays);
      EXPECT_EQ(aligned.leaves, leaves);
    }
}

TEST(Alignment, cuts_segments_into_equal_parts) {
  const StateTable table({3, 2});
  const ObservedSequence sequence = random_sequence({9, 6, 7}, 2, 1, 1, 1, 4);
  const Alignment aligned = align_equally(sequence, table);
  std::vector<int> states;
  for (const Occupancy& at : aligned.occupancies) states.push_back(at.state);
  EXPECT_EQ(states,
            (std::vector<int>{0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 0, 0, 0, 1, 1, 2, 2}));
  EXPECT_EQ(aligned.occupancies.front().frame, 4);
  EXPECT_EQ(aligned.stays, (std::vector<double>{4, 3, 3, 2, 2}));
  EXPECT_EQ(aligned.leaves, (std::vector<double>{2, 2, 2, 1, 1}));
}

TEST(Alignment, a_sequence_too_short_for_its_states_keeps_equal_parts) {
  const StateTable table({4, 4});
  const ObservedSequence sequence = random_sequence({2, 3}, 2, 2, 1, 1);
  const EmissionModel model = random_emissions(table.total, 2, 3);
  const Alignment equal = align_equally(sequence, table);
  double expected = 0;
  for (const Occupancy& at : equal.occupancies)
    expected += model.of_state[at.state].log_likelihoods(sequence.x.col(at.frame))[0];
  for (int state = 0; state < table.total; ++state)
    expected += equal.stays[state] * std::log(model.stay[state]) +
                equal.leaves[state] * std::log(1 - model.stay[state]);
  for (const bool hard : {false, true}) {
    const Alignment aligned = align(sequence, table, model, 2, hard);
    ASSERT_EQ(aligned.occupancies.size(), equal.occupancies.size());
    for (std::size_t i = 0; i < equal.occupancies.size(); ++i)
      EXPECT_EQ(aligned.occupancies[i].state, equal.occupancies[i].state);
    EXPECT_NEAR(aligned.log_likelihood, expected, 1e-9);
  }
}

TEST(Gaussian, log_likelihoods_are_those_of_the_formula) {
  const EmissionModel model = random_emissions(1, 4, 9);
  std::mt19937 random(9);  // the same numbers again
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> stay(0.2, 0.9);
  const Eigen::VectorXd mean = Eigen::VectorXd::NullaryExpr(4, [&] { return normal(random); });
  const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(4, 4, [&] { return normal(random); });
  const Eigen::MatrixXd covariance = root * root.transpose() + Eigen::MatrixXd::Identity(4, 4);
  const Eigen::MatrixXd frames = Eigen::MatrixXd::Random(4, 6);
  const Eigen::VectorXd said = model.of_state[0].log_likelihoods(frames);
  EXPECT_NEAR(model.of_state[0].log_determinant(), std::log(covariance.determinant()), 1e-9);
  for (int i = 0; i < 6; ++i) {
    const Eigen::VectorXd from_mean = frames.col(i) - mean;
    EXPECT_NEAR(said[i],
                -0.5 * (from_mean.dot(covariance.inverse() * from_mean) +
                        std::log(covariance.determinant()) + 4 * std::log(2 * std::numbers::pi)),
                1e-9);
  }
  EXPECT_TRUE(model.of_state[0].valid());
  EXPECT_FALSE(Gaussian(mean, -covariance).valid());
}

}  // namespace
}  // namespace gait
