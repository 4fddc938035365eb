#include "gait/play/recognise/packed_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>

namespace gait {
namespace {

using Shape = PackedMap::Shape;

Eigen::MatrixXd random_matrix(int rows, int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

Eigen::MatrixXd random_triangle(int size, unsigned seed) {
  return random_matrix(size, size, seed).triangularView<Eigen::Lower>();
}

Eigen::VectorXd random_vector(int size, unsigned seed) { return random_matrix(size, 1, seed); }

Eigen::VectorXf in_whole_panels(const Eigen::VectorXd& vector, float behind) {
  Eigen::VectorXf padded =
      Eigen::VectorXf::Constant(PackedMap::padded(static_cast<int>(vector.size())), behind);
  padded.head(vector.size()) = vector.cast<float>();
  return padded;
}

// Every kernel of this processor in turn; then the one before again.
class PackedMapKernels : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    if (GetParam() >= panel_kernels().size())
      GTEST_SKIP() << "this processor has " << panel_kernels().size() << " kernels";
    use_panel_kernel(panel_kernels()[GetParam()]);
  }
  void TearDown() override { use_panel_kernel(before_); }

 private:
  const PanelKernel& before_ = panel_kernel();
};

TEST_P(PackedMapKernels, apply_a_triangle_as_eigen_does_for_every_size) {
  const Eigen::MatrixXd largest = random_triangle(200, 1);
  for (int size = 1; size <= 200; ++size) {
    const Eigen::MatrixXd lower = largest.bottomRightCorner(size, size);
    const Eigen::VectorXd start = random_vector(size, 2), x = random_vector(size, 7);
    const PackedMap map(lower, start, Shape::lower);
    Eigen::VectorXf result = Eigen::VectorXf::Constant(PackedMap::padded(size), 1e9f);
    const float squares = map.apply(in_whole_panels(x, 0).data(), size, result.data());
    const Eigen::VectorXd expected = start + lower * x;
    // Rounding of `size` products, each of about one.
    EXPECT_LT((result.head(size).cast<double>() - expected).cwiseAbs().maxCoeff(),
              2e-6 * std::max(4, size))
        << "size " << size;
    EXPECT_NEAR(squares, expected.squaredNorm(), 1e-5 * expected.squaredNorm()) << "size " << size;
  }
}

TEST_P(PackedMapKernels, leading_rows_of_a_triangle_need_only_the_leading_entries) {
  const int size = 77;
  const Eigen::MatrixXd lower = random_triangle(size, 3);
  const Eigen::VectorXd start = random_vector(size, 4);
  const PackedMap map(lower, start, Shape::lower);
  for (int count = 0; count <= size; ++count) {
    // What lies behind may be anything that is a number, and no row may depend on it.
    Eigen::VectorXf x = Eigen::VectorXf::Constant(PackedMap::padded(size), 1e6f);
    x.head(count).setOnes();
    Eigen::VectorXf result = Eigen::VectorXf::Constant(x.size(), -3.0f);
    const float squares = map.apply(x.data(), count, result.data());
    const Eigen::VectorXd expected =
        start.head(count) + lower.topLeftCorner(count, count) * Eigen::VectorXd::Ones(count);
    if (count > 0) {
      EXPECT_LT((result.head(count).cast<double>() - expected).cwiseAbs().maxCoeff(), 2e-4);
    }
    EXPECT_NEAR(squares, expected.squaredNorm(), 1e-5 * expected.squaredNorm());
    for (int i = PackedMap::padded(count); i < x.size(); ++i)
      EXPECT_EQ(result[i], -3.0f) << "nothing was asked of row " << i;
  }
}

TEST_P(PackedMapKernels, apply_leading_columns_of_a_full_matrix) {
  for (const auto& [rows, columns] : {std::pair(1, 1), {15, 144}, {16, 5}, {81, 33}, {33, 81}}) {
    const Eigen::MatrixXd matrix = random_matrix(rows, columns, 5);
    const Eigen::VectorXd start = random_vector(rows, 6), x = random_vector(columns, 7);
    const PackedMap map(matrix, start, Shape::full);
    EXPECT_EQ(map.rows(), rows);
    for (int count = 0; count <= columns; ++count) {
      Eigen::VectorXf result = Eigen::VectorXf::Constant(PackedMap::padded(rows), 1e9f);
      const float squares = map.apply(in_whole_panels(x, 0).data(), count, result.data());
      const Eigen::VectorXd expected = start + matrix.leftCols(count) * x.head(count);
      EXPECT_LT((result.head(rows).cast<double>() - expected).cwiseAbs().maxCoeff(), 2e-4);
      EXPECT_NEAR(squares, expected.squaredNorm(), 1e-5 * expected.squaredNorm());
    }
  }
}

// Applies a map with the stack `deeper` bytes further down.
[[gnu::noinline]] float apply_deeper(std::size_t deeper, const PackedMap& map, const float* x,
                                     int count, float* result) {
  volatile char* const taken = static_cast<char*>(__builtin_alloca(deeper + 1));
  taken[deeper] = 1;
  return map.apply(x, count, result);
}

TEST_P(PackedMapKernels, read_and_write_at_any_address_wherever_the_stack_is) {
  for (const int size : {1, 15, 16, 17, 33, 144, 145}) {
    const Eigen::MatrixXd lower = random_triangle(size, 11);
    const Eigen::VectorXd start = random_vector(size, 12);
    const PackedMap map(lower, start, Shape::lower);
    const Eigen::VectorXd expected = start + lower * Eigen::VectorXd::Constant(size, 0.5);
    for (const std::size_t deeper : {0, 16, 32, 48, 64})
      for (const int odd : {0, 1, 2, 3, 7}) {
        std::vector<float> x(PackedMap::padded(size) + odd, 0.5f), result(x.size());
        apply_deeper(deeper, map, x.data() + odd, size, result.data() + odd);
        for (int i = 0; i < size; ++i)
          EXPECT_NEAR(result[odd + i], expected[i], 1e-6 * std::max(4, size));
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Widest, PackedMapKernels, testing::Values(0, 1, 2), [](const auto& index) {
  return index.param < panel_kernels().size() ? std::string(panel_kernels()[index.param].name)
                                              : "none" + std::to_string(index.param);
});

TEST(PackedMap, takes_the_kernel_that_the_environment_names_or_the_widest) {
  const char* const wanted = std::getenv("GAIT_KERNEL");
  EXPECT_EQ(panel_kernel().name, wanted ? wanted : panel_kernels().front().name);
  EXPECT_EQ(panel_kernels().back().name, "portable");
}

}  // namespace
}  // namespace gait
