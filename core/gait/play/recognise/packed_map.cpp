#include "gait/play/recognise/packed_map.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace gait {

namespace {

constexpr int panel = PackedMap::panel;

template <int width>
struct Vectors;
template <>
struct Vectors<4> {
  using Vector = float __attribute__((vector_size(16)));
};
template <>
struct Vectors<8> {
  using Vector = float __attribute__((vector_size(32)));
};
template <>
struct Vectors<16> {
  using Vector = float __attribute__((vector_size(64)));
};

// One product, with vectors that the processor holds in one register: compilers keep wider ones on
// the stack. It takes `unrolled` columns at a time, each with sums of its own, so that no product
// waits for the one before.
template <int width, int unrolled>
[[gnu::always_inline]] inline float multiply_panels(const PanelProduct& product, const float* x,
                                                    float* result) noexcept {
  using Vector = typename Vectors<width>::Vector;
  constexpr int pieces = panel / width;  // of a column
  const float* entries = product.panels;
  Vector squares[pieces] = {};
  float rest = 0;
  for (int p = 0; p < product.count; ++p) {
    Vector sums[unrolled][pieces] = {};
    const int columns = std::min(product.columns + p * product.growth, product.most);
    const auto add = [&](Vector(&sum)[pieces], int column) __attribute__((always_inline)) {
      const auto* const from =
          reinterpret_cast<const Vector*>(entries + static_cast<std::ptrdiff_t>(column) * panel);
#pragma GCC unroll 4
      for (int piece = 0; piece < pieces; ++piece) sum[piece] += from[piece] * x[column];
    };
#pragma GCC unroll 4
    for (int piece = 0; piece < pieces; ++piece)
      sums[0][piece] = reinterpret_cast<const Vector*>(product.start + p * panel)[piece];
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
      // Not through a vector type with less alignment: Clang forgets that in templates.
      std::memcpy(result + p * panel + piece * width, &sums[0][piece], sizeof(Vector));
    }
    if ((p + 1) * panel <= product.rows) {
#pragma GCC unroll 4
      for (int piece = 0; piece < pieces; ++piece)
        squares[piece] += sums[0][piece] * sums[0][piece];
    } else {
      for (int row = p * panel; row < product.rows; ++row) rest += result[row] * result[row];
    }
    entries += static_cast<std::ptrdiff_t>(std::max(columns, product.stored)) * panel;
  }
#pragma GCC unroll 4
  for (int piece = 1; piece < pieces; ++piece) squares[0] += squares[piece];
  for (int lane = 0; lane < width; ++lane) rest += squares[0][lane];
  return rest;
}

float multiply_anywhere(const PanelProduct& product, const float* x, float* result) noexcept {
  return multiply_panels<4, 2>(product, x, result);
}

#if defined(__x86_64__)
[[gnu::target("avx2,fma")]] float multiply_avx2(const PanelProduct& product, const float* x,
                                                float* result) noexcept {
  return multiply_panels<8, 4>(product, x, result);
}

[[gnu::target("avx512f")]] float multiply_avx512(const PanelProduct& product, const float* x,
                                                 float* result) noexcept {
  return multiply_panels<16, 4>(product, x, result);
}
#endif

struct Kernels {
  std::array<PanelKernel, 3> all;
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

Kernels kernels;

}  // namespace

PackedMap::PackedMap(const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                     const Eigen::Ref<const Eigen::VectorXd>& start, Shape shape)
    : shape_(shape),
      rows_(static_cast<int>(matrix.rows())),
      columns_(static_cast<int>(matrix.cols())) {
  for (int row = 0; row < padded(rows_); ++row)
    start_.push_back(row < rows_ ? static_cast<float>(start[row]) : 0.0f);
  for (int first = 0; first < rows_; first += panel) {
    const int columns = shape_ == Shape::full ? columns_ : std::min(first + panel, columns_);
    for (int column = 0; column < columns; ++column)
      for (int row = first; row < first + panel; ++row)
        panels_.push_back(row < rows_ && (shape_ == Shape::full || row >= column)
                              ? static_cast<float>(matrix(row, column))
                              : 0.0f);
  }
}

float PackedMap::apply(const float* x, int count, float* result) const noexcept {
  const bool lower = shape_ == Shape::lower;
  count = std::min(count, columns_);
  const int rows = lower ? count : rows_;
  return panel_kernel().multiply({.panels = panels_.data(),
                                  .start = start_.data(),
                                  .count = (rows + panel - 1) / panel,
                                  .columns = lower ? panel : count,
                                  .growth = lower ? panel : 0,
                                  .most = lower ? columns_ : count,
                                  .stored = lower ? 0 : columns_,
                                  .rows = rows},
                                 x, result);
}

std::span<const PanelKernel> panel_kernels() noexcept {
  return {kernels.all.data(), kernels.count};
}

const PanelKernel& panel_kernel() noexcept { return kernels.all[kernels.chosen]; }

void use_panel_kernel(const PanelKernel& kernel) noexcept {
  kernels.chosen = static_cast<std::size_t>(&kernel - kernels.all.data());
}

}  // namespace gait
