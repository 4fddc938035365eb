#include "gait/learn/state_statistics.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>

#include "gait/learn/parallel.h"
#include "learn/random_sequences.h"

namespace gait {
namespace {

using testing::random_sequences;

// Alignments that share frames between neighbouring states, as Baum-Welch gives them.
std::vector<Alignment> blurred(const std::vector<ObservedSequence>& sequences,
                               const StateTable& table) {
  std::vector<Alignment> alignments;
  for (const ObservedSequence& sequence : sequences) {
    Alignment alignment = align_equally(sequence, table);
    std::vector<Occupancy> shared;
    for (const Occupancy& at : alignment.occupancies) {
      const double share = 0.5 + 0.5 * (at.frame % 7) / 7.0;
      shared.push_back({at.frame, at.state, share});
      shared.push_back({at.frame, (at.state + 1) % table.total, 1 - share});
    }
    alignment.occupancies = shared;
    alignments.push_back(alignment);
  }
  return alignments;
}

struct Data {
  StateTable table{{3, 2}};
  std::vector<ObservedSequence> sequences = random_sequences(6, 5, 4, 3, 1);
  std::vector<Alignment> alignments = blurred(sequences, table);
  std::vector<int> all{0, 1, 2, 3, 4, 5};

  std::vector<StateStatistics> of(const std::vector<int>& chosen, int threads = 1) const {
    return gather(sequences, alignments, chosen, table.total, 2, threads);
  }
};

TEST(StateStatistics, are_the_same_to_the_bit_for_any_number_of_threads) {
  const Data data;
  const auto one = data.of(data.all, 1);
  for (const int threads : {2, 3, 7}) {
    const auto many = data.of(data.all, threads);
    for (int state = 0; state < data.table.total; ++state) {
      EXPECT_EQ(one[state].count, many[state].count);
      EXPECT_EQ(one[state].sum, many[state].sum);
      EXPECT_EQ(one[state].products, many[state].products);
      EXPECT_EQ(one[state].style_counts, many[state].style_counts);
      EXPECT_EQ(one[state].style_sums, many[state].style_sums);
    }
  }
}

TEST(StateStatistics, give_the_weighted_mean_and_covariance) {
  Data data;
  data.sequences[4].style = -1;
  const auto statistics = data.of(data.all);
  for (int state = 0; state < data.table.total; ++state) {
    double count = 0;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(7);
    Eigen::VectorXd counts = Eigen::VectorXd::Zero(3);
    Eigen::MatrixXd means = Eigen::MatrixXd::Zero(7, 3);  // of styles 0 and 1, and of none
    const auto each = [&](auto work) {
      for (const int i : data.all)
        for (const Occupancy& at : data.alignments[i].occupancies) {
          if (at.state != state) continue;
          Eigen::VectorXd z(7);
          z << data.sequences[i].x.col(at.frame), data.sequences[i].y.col(at.frame);
          const int style = data.sequences[i].style < 0 ? 2 : data.sequences[i].style;
          work(at.share, z, style);
        }
    };
    each([&](double share, const Eigen::VectorXd& z, int style) {
      count += share;
      mean += share * z;
      counts[style] += share;
      means.col(style) += share * z;
    });
    mean /= count;
    for (int style = 0; style < 3; ++style) means.col(style) /= counts[style];
    Eigen::MatrixXd about_mean = Eigen::MatrixXd::Zero(7, 7), about_style = about_mean;
    each([&](double share, const Eigen::VectorXd& z, int style) {
      about_mean += share * (z - mean) * (z - mean).transpose();
      about_style += share * (z - means.col(style)) * (z - means.col(style)).transpose();
    });
    EXPECT_NEAR(statistics[state].count, count, 1e-9);
    EXPECT_TRUE(statistics[state].mean().isApprox(mean, 1e-10));
    EXPECT_TRUE(statistics[state].covariance().isApprox(about_mean / count, 1e-9));
    EXPECT_TRUE(statistics[state].within_style_covariance(4).isApprox(
        about_style.topLeftCorner(4, 4) / count, 1e-9));
    EXPECT_TRUE(statistics[state].style_counts.isApprox(counts.head(2), 1e-10));
  }
}

TEST(StateStatistics, of_all_less_a_fold_are_those_of_the_rest) {
  const Data data;
  auto all = data.of(data.all);
  const auto fold = data.of({1, 3}), rest = data.of({0, 2, 4, 5});
  for (int state = 0; state < data.table.total; ++state) {
    all[state] -= fold[state];
    EXPECT_NEAR(all[state].count, rest[state].count, 1e-9);
    EXPECT_TRUE(all[state].covariance().isApprox(rest[state].covariance(), 1e-9));
    EXPECT_TRUE(all[state].within_style_covariance(4).isApprox(
        rest[state].within_style_covariance(4), 1e-9));
    EXPECT_NEAR(all[state].style_counts[1], 0, 1e-9 + rest[state].style_counts[1]);
    all[state] += fold[state];
    EXPECT_NEAR(all[state].count, data.of(data.all)[state].count, 1e-9);
  }
}

// Of many values, where a state had no frame: Eigen's product of no columns divides by their
// number.
TEST(StateStatistics, of_a_state_without_frames_are_none) {
  std::vector<ObservedSequence> sequences(1);
  sequences[0].x = Eigen::MatrixXd::Random(216, 6);
  sequences[0].y = Eigen::MatrixXd::Random(162, 6);
  std::vector<Alignment> alignments(1);
  for (int frame = 0; frame < 6; ++frame) alignments[0].occupancies.push_back({frame, 0, 1.0});
  const auto statistics = gather(sequences, alignments, {0}, 2, 0, 1);
  EXPECT_EQ(statistics[0].count, 6);
  EXPECT_EQ(statistics[1].count, 0);
  EXPECT_EQ(statistics[1].products.norm(), 0);
}

TEST(InParallel, does_each_piece_once_for_any_number_of_threads) {
  for (const int threads : {0, 1, 2, 5, 100}) {
    std::vector<std::atomic<int>> done(37);
    in_parallel(37, threads, [&](int i) { ++done[i]; });
    for (const auto& count : done) EXPECT_EQ(count, 1);
  }
  in_parallel(0, 4, [](int) { FAIL() << "there is nothing to do"; });
  EXPECT_GE(threads_to_use(0), 1);
  EXPECT_EQ(threads_to_use(3), 3);
}

TEST(InParallel, throws_the_failure_of_a_piece_on_and_stops) {
  for (const int threads : {1, 2, 4}) {
    std::atomic<int> done{0};
    try {
      in_parallel(100000, threads, [&](int i) {
        if (i == 3) throw std::runtime_error("piece 3");
        ++done;
      });
      FAIL() << "no failure";
    } catch (const std::runtime_error& failure) {
      EXPECT_STREQ(failure.what(), "piece 3");
    }
    if (threads == 1) {
      EXPECT_EQ(done, 3);
    }
  }
}

}  // namespace
}  // namespace gait
