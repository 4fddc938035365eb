#include "gait/play/recognise/triangular.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>

namespace gait {
namespace {

Eigen::MatrixXd random_triangle(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd lower = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return normal(random); });
  lower.triangularView<Eigen::StrictlyUpper>().setZero();
  return lower;
}

TEST(PackedTriangle, times_a_vector_is_what_eigen_says_for_every_size) {
  const Eigen::MatrixXd largest = random_triangle(200, 1);
  for (int size = 1; size <= 200; ++size) {
    const Eigen::MatrixXd lower = largest.bottomRightCorner(size, size);
    const PackedTriangle packed(lower);
    ASSERT_EQ(packed.size, size);
    ASSERT_EQ(packed.padded() % PackedTriangle::rows, 0);
    ASSERT_GE(packed.padded(), size);
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    Eigen::VectorXf x =
        Eigen::VectorXf::NullaryExpr(packed.padded(), [&] { return normal(random); });
    Eigen::VectorXf result = Eigen::VectorXf::Constant(packed.padded(), 1e9f);
    multiply(packed, x.data(), size, result.data());
    const Eigen::VectorXd expected = lower * x.head(size).cast<double>();
    // Rounding of `size` products, each of about one.
    EXPECT_LT((result.head(size).cast<double>() - expected).cwiseAbs().maxCoeff(),
              2e-6 * std::max(4, size))
        << "size " << size;
  }
}

TEST(PackedTriangle, leading_rows_need_only_the_leading_entries) {
  const int size = 77;
  const Eigen::MatrixXd lower = random_triangle(size, 3);
  const PackedTriangle packed(lower);
  for (int count = 0; count <= size; ++count) {
    Eigen::VectorXf x = Eigen::VectorXf::Ones(packed.padded());
    // What lies behind may be anything that is a number, and no row may depend on it.
    x.tail(packed.padded() - count).setConstant(1e6f);
    Eigen::VectorXf result = Eigen::VectorXf::Constant(packed.padded(), -3.0f);
    multiply(packed, x.data(), count, result.data());
    if (count == 0) {
      EXPECT_EQ(result[0], -3.0f) << "nothing was asked";
      continue;
    }
    const Eigen::VectorXd expected =
        lower.topLeftCorner(count, count) * Eigen::VectorXd::Ones(count);
    EXPECT_LT((result.head(count).cast<double>() - expected).cwiseAbs().maxCoeff(), 2e-4);
    const int written =
        (count + PackedTriangle::rows - 1) / PackedTriangle::rows * PackedTriangle::rows;
    for (int i = written; i < packed.padded(); ++i) EXPECT_EQ(result[i], -3.0f);
  }
}

TEST(PackedTriangle, reads_and_writes_at_any_address) {
  const int size = 33;
  const Eigen::MatrixXd lower = random_triangle(size, 5);
  const PackedTriangle packed(lower);
  std::vector<float> x(packed.padded() + 1, 0.5f), result(packed.padded() + 3);
  multiply(packed, x.data() + 1, size, result.data() + 3);
  const Eigen::VectorXd expected = lower * Eigen::VectorXd::Constant(size, 0.5);
  for (int i = 0; i < size; ++i) EXPECT_NEAR(result[3 + i], expected[i], 1e-4);
}

TEST(PackedTriangle, times_a_vector_is_the_same_with_every_kernel_of_this_processor) {
  ASSERT_EQ(triangle_kernels().back().name, "portable");
  for (const int size : {1, 15, 16, 17, 33, 144, 145}) {
    const Eigen::MatrixXd lower = random_triangle(size, 11);
    const PackedTriangle packed(lower);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(packed.panels.data()) % 64, 0u);
    const Eigen::VectorXd expected = lower * Eigen::VectorXd::Constant(size, 0.5);
    for (const TriangleKernel& kernel : triangle_kernels())
      for (const int odd : {0, 1, 3}) {
        std::vector<float> x(packed.padded() + odd, 0.5f), result(packed.padded() + odd);
        kernel.multiply(packed.panels.data(), x.data() + odd,
                        packed.padded() / PackedTriangle::rows, size, result.data() + odd);
        for (int i = 0; i < size; ++i)
          EXPECT_NEAR(result[odd + i], expected[i], 1e-6 * std::max(4, size)) << kernel.name;
      }
  }
}

}  // namespace
}  // namespace gait
