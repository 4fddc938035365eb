#include "gait/learn/principal_components.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <random>

#include "gait/corpus/corpus.h"
#include "gait/error.h"
#include "gait/learn/cycles.h"
#include "gait/learn/walk_sequences.h"
#include "gait/teach/walk_model.h"

namespace gait {
namespace {

// Rows whose variance falls off from direction to direction as that of walks does.
Eigen::MatrixXd fading_rows(int rows, int columns, double fade) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const auto noise = [&] { return normal(random); };
  const int rank = std::min(rows, columns);
  Eigen::MatrixXd left = Eigen::MatrixXd::NullaryExpr(rows, rank, noise);
  const Eigen::MatrixXd right = Eigen::MatrixXd::NullaryExpr(rank, columns, noise);
  for (int i = 0; i < rank; ++i) left.col(i) *= std::pow(fade, i);
  return (left * right).array() + 0.7;
}

// The first 15 cycles of each of the eleven styles, as in T10 §4: 165 rows of 2160 values.
const Eigen::MatrixXd& corpus_rows() {
  static const Eigen::MatrixXd rows = [] {
    std::vector<Walk> walks;
    for (CorpusWalk& walk : make_corpus())
      walks.push_back({std::move(walk.clip), walk.style, {}, {}, std::move(walk.contacts)});
    const WalkSequences sequences = walk_sequences(walks, {});
    const std::vector<CapturedCycle> cycles = cut_cycles(walks, sequences.body, 40);
    Eigen::MatrixXd matrix(165, cycles.front().values.size());
    Eigen::Index row = 0;
    for (const std::string& style : sequences.styles) {
      int of_style = 0;
      for (const CapturedCycle& cycle : cycles)
        if (walks[cycle.walk].style == style && of_style++ < 15)
          matrix.row(row++) = cycle.values.transpose();
    }
    EXPECT_EQ(row, 165);
    return matrix;
  }();
  return rows;
}

// Against the singular values of the centred rows.
void expect_as_by_svd(const Eigen::MatrixXd& rows, const ComponentChoice& choice) {
  Eigen::MatrixXd centred = rows.rowwise() - rows.colwise().mean();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(centred, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Eigen::MatrixXd given = rows;
  const PrincipalComponents found = principal_components(given, choice);
  const Eigen::Index kept = found.components.cols();
  ASSERT_EQ(found.variances.size(), std::min(rows.rows() - 1, rows.cols()));
  const auto freedom = static_cast<double>(rows.rows() - 1);
  const double largest = std::pow(svd.singularValues()[0], 2) / freedom;
  for (Eigen::Index i = 0; i < found.variances.size(); ++i) {
    const double wanted = std::pow(svd.singularValues()[i], 2) / freedom;
    EXPECT_NEAR(found.variances[i], wanted, 1e-9 * (i < kept ? wanted : largest)) << "of " << i;
  }
  EXPECT_LT((found.mean - rows.colwise().mean().transpose()).cwiseAbs().maxCoeff(), 1e-12);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(kept, kept);
  EXPECT_LT((found.components.transpose() * found.components - identity).norm(), 1e-9);
  const Eigen::MatrixXd ours = centred * found.components * found.components.transpose();
  const Eigen::MatrixXd theirs = svd.matrixU().leftCols(kept) *
                                 svd.singularValues().head(kept).asDiagonal() *
                                 svd.matrixV().leftCols(kept).transpose();
  EXPECT_LT((ours - theirs).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PrincipalComponents, of_fewer_rows_than_values_are_those_of_a_dense_svd) {
  expect_as_by_svd(fading_rows(40, 300, 0.9), {.share = 0.9});
}

TEST(PrincipalComponents, of_more_rows_than_values_are_those_of_a_dense_svd) {
  expect_as_by_svd(fading_rows(400, 60, 0.9), {.share = 0.99});
}

TEST(PrincipalComponents, of_as_many_rows_as_values_are_those_of_a_dense_svd) {
  expect_as_by_svd(fading_rows(50, 50, 0.9), {.share = 0.9});
}

TEST(PrincipalComponents, of_the_built_in_walks_are_those_of_a_dense_svd) {
  expect_as_by_svd(corpus_rows(), {.share = 0.99});
}

TEST(PrincipalComponents, as_many_are_kept_as_carry_the_share_and_not_one_more) {
  for (const double share : {0.5, 0.8, 0.9, 0.99}) {
    Eigen::MatrixXd rows = corpus_rows();
    const PrincipalComponents found = principal_components(rows, {.share = share});
    const Eigen::Index kept = found.components.cols();
    EXPECT_GE(found.variances.head(kept).sum(), share * found.variances.sum());
    EXPECT_LT(found.variances.head(kept - 1).sum(), share * found.variances.sum());
    RecordProperty("components for " + std::to_string(share), std::to_string(kept));
  }
}

TEST(PrincipalComponents, their_number_may_be_said_instead_and_is_never_more_than_there_are) {
  Eigen::MatrixXd rows = fading_rows(10, 30, 0.9), again = rows;
  EXPECT_EQ(principal_components(rows, {.count = 4}).components.cols(), 4);
  EXPECT_EQ(principal_components(again, {.count = 99}).components.cols(), 9);
  rows = fading_rows(10, 30, 0.9);
  EXPECT_EQ(principal_components(rows, {.share = 0.999, .most = 3}).components.cols(), 3);
}

TEST(PrincipalComponents, have_the_same_signs_whatever_the_order_of_the_rows) {
  Eigen::MatrixXd rows = fading_rows(30, 80, 0.8), turned = rows.colwise().reverse();
  const PrincipalComponents a = principal_components(rows, {.count = 6}),
                            b = principal_components(turned, {.count = 6});
  EXPECT_LT((a.components - b.components).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PrincipalComponents, of_less_than_two_rows_or_of_no_numbers_are_refused) {
  Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 5), strange = Eigen::MatrixXd::Ones(4, 5);
  strange(2, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(principal_components(one, {}), Error);
  EXPECT_THROW(principal_components(strange, {}), Error);
}

// Processor time, the best of some: others may be using the machine.
TEST(PrincipalComponents, of_the_built_in_walks_take_less_than_30_ms) {
#if !defined(NDEBUG) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "speed is of interest in Release builds only";
#endif
  double best = 1;
  for (int i = 0; i < 10; ++i) {
    Eigen::MatrixXd rows = corpus_rows();
    const std::clock_t start = std::clock();
    principal_components(rows, {.share = 0.9});
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  RecordProperty("milliseconds", std::to_string(1000 * best));
  EXPECT_LT(best, 0.03);
}

}  // namespace
}  // namespace gait
