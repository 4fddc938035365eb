#include "gait/play/recognise/triangular.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>

namespace gait {

namespace {

constexpr int rows = PackedTriangle::rows;

// Vectors of `width` floats, at their own alignment and at any.
template <int width>
struct Vectors;
template <>
struct Vectors<4> {
  using Aligned = float __attribute__((vector_size(16)));
  using Anywhere = float __attribute__((vector_size(16), aligned(alignof(float))));
};
template <>
struct Vectors<8> {
  using Aligned = float __attribute__((vector_size(32)));
  using Anywhere = float __attribute__((vector_size(32), aligned(alignof(float))));
};
template <>
struct Vectors<16> {
  using Aligned = float __attribute__((vector_size(64)));
  using Anywhere = float __attribute__((vector_size(64), aligned(alignof(float))));
};

// One product, with vectors that the processor holds in one register: compilers keep wider ones on
// the stack. It takes `unrolled` columns at a time, each with sums of its own, so that no product
// waits for the one before.
template <int width, int unrolled>
[[gnu::always_inline]] inline void multiply_panels(const float* panel, const float* x, int panels,
                                                   int size, float* result) noexcept {
  using Vector = typename Vectors<width>::Aligned;
  using Anywhere = typename Vectors<width>::Anywhere;
  constexpr int pieces = rows / width;  // of a column
  for (int p = 0; p < panels; ++p) {
    Vector sums[unrolled][pieces] = {};
    const int columns = std::min((p + 1) * rows, size);
    const auto add = [&](Vector(&sum)[pieces], int column) __attribute__((always_inline)) {
      const auto* const entries =
          reinterpret_cast<const Vector*>(panel + static_cast<std::ptrdiff_t>(column) * rows);
#pragma GCC unroll 4
      for (int piece = 0; piece < pieces; ++piece) sum[piece] += entries[piece] * x[column];
    };
    int column = 0;
    for (; column + unrolled <= columns; column += unrolled) {
#pragma GCC unroll 4
      for (int i = 0; i < unrolled; ++i) add(sums[i], column + i);
    }
    for (; column < columns; ++column) add(sums[0], column);
#pragma GCC unroll 4
    for (int piece = 0; piece < pieces; ++piece) {
#pragma GCC unroll 4
      for (int i = 1; i < unrolled; ++i) sums[0][piece] += sums[i][piece];
      *reinterpret_cast<Anywhere*>(result + p * rows + piece * width) = sums[0][piece];
    }
    panel += static_cast<std::ptrdiff_t>(columns) * rows;
  }
}

void multiply_anywhere(const float* panel, const float* x, int panels, int size,
                       float* result) noexcept {
  multiply_panels<4, 2>(panel, x, panels, size, result);
}

#if defined(__x86_64__)
[[gnu::target("avx2,fma")]] void multiply_avx2(const float* panel, const float* x, int panels,
                                               int size, float* result) noexcept {
  multiply_panels<8, 4>(panel, x, panels, size, result);
}

[[gnu::target("avx512f")]] void multiply_avx512(const float* panel, const float* x, int panels,
                                                int size, float* result) noexcept {
  multiply_panels<16, 4>(panel, x, panels, size, result);
}
#endif

struct Kernels {
  std::array<TriangleKernel, 3> all;
  std::size_t count = 0, chosen = 0;

  Kernels() noexcept {
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f")) all[count++] = {"avx512", multiply_avx512};
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
      all[count++] = {"avx2", multiply_avx2};
#endif
    all[count++] = {"portable", multiply_anywhere};
    const char* const wanted = std::getenv("GAIT_KERNEL");
    for (std::size_t i = 0; wanted != nullptr && i < count; ++i)
      if (all[i].name == wanted) chosen = i;
  }
};

const Kernels kernels;

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
  kernels.all[kernels.chosen].multiply(triangle.panels.data(), x,
                                       (std::min(count, triangle.size) + rows - 1) / rows,
                                       triangle.size, result);
}

std::span<const TriangleKernel> triangle_kernels() noexcept {
  return {kernels.all.data(), kernels.count};
}

}  // namespace gait
