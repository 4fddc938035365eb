#include "gait/play/recognise/triangular.h"

#include <algorithm>
#include <cstddef>

namespace gait {

namespace {

constexpr int rows = PackedTriangle::rows;

// A column of a panel. The compiler makes of it what the processor has: four, two or one register.
using Column = float __attribute__((vector_size(rows * sizeof(float)), aligned(alignof(float))));

// `unrolled` columns at a time, each with a sum of its own: a product does not wait for the last.
template <int unrolled>
[[gnu::always_inline]] inline void multiply_panels(const float* panel, const float* x, int panels,
                                                   int size, float* result) noexcept {
  for (int p = 0; p < panels; ++p) {
    Column sums[unrolled] = {};
    const int columns = std::min((p + 1) * rows, size);
    int column = 0;
    for (; column + unrolled <= columns; column += unrolled)
      for (int i = 0; i < unrolled; ++i)
        sums[i] += *reinterpret_cast<const Column*>(
                       panel + static_cast<std::ptrdiff_t>(column + i) * rows) *
                   x[column + i];
    for (; column < columns; ++column)
      sums[0] +=
          *reinterpret_cast<const Column*>(panel + static_cast<std::ptrdiff_t>(column) * rows) *
          x[column];
    for (int i = 1; i < unrolled; ++i) sums[0] += sums[i];
    *reinterpret_cast<Column*>(result + p * rows) = sums[0];
    panel += static_cast<std::ptrdiff_t>(columns) * rows;
  }
}

using Kernel = void (*)(const float*, const float*, int, int, float*) noexcept;

void multiply_anywhere(const float* panel, const float* x, int panels, int size,
                       float* result) noexcept {
  multiply_panels<2>(panel, x, panels, size, result);
}

#if defined(__x86_64__)
[[gnu::target("avx2,fma")]] void multiply_avx2(const float* panel, const float* x, int panels,
                                               int size, float* result) noexcept {
  multiply_panels<4>(panel, x, panels, size, result);
}

[[gnu::target("avx512f")]] void multiply_avx512(const float* panel, const float* x, int panels,
                                                int size, float* result) noexcept {
  multiply_panels<4>(panel, x, panels, size, result);
}
#endif

Kernel best_kernel() noexcept {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f")) return multiply_avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return multiply_avx2;
#endif
  return multiply_anywhere;
}

const Kernel kernel = best_kernel();

}  // namespace

PackedTriangle::PackedTriangle(const Eigen::Ref<const Eigen::MatrixXd>& lower)
    : size(static_cast<int>(lower.rows())) {
  for (int first = 0; first < size; first += rows)
    for (int column = 0; column < std::min(first + rows, size); ++column)
      for (int row = first; row < first + rows; ++row)
        panels.push_back(row < size && row >= column ? static_cast<float>(lower(row, column))
                                                     : 0.0f);
}

void multiply(const PackedTriangle& triangle, const float* x, int count, float* result) noexcept {
  kernel(triangle.panels.data(), x, (std::min(count, triangle.size) + rows - 1) / rows,
         triangle.size, result);
}

}  // namespace gait
