#include "gait/play/triangular.h"

#include <algorithm>

// One body, compiled for several processors, the best one taken when the program starts. Sanitizers
// and other processors do without.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GAIT_FOR_EACH_PROCESSOR __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define GAIT_FOR_EACH_PROCESSOR
#endif

namespace gait {

namespace {

constexpr int rows = PackedTriangle::rows;

GAIT_FOR_EACH_PROCESSOR
void multiply_panels(const float* panel, const float* x, int panels, int size,
                     float* result) noexcept {
  for (int p = 0; p < panels; ++p) {
    float sum[rows] = {};
    const int columns = std::min((p + 1) * rows, size);
    for (int column = 0; column < columns; ++column) {
      const float value = x[column];
      const float* entry = panel + static_cast<std::ptrdiff_t>(column) * rows;
      for (int row = 0; row < rows; ++row) sum[row] += entry[row] * value;
    }
    for (int row = 0; row < rows; ++row) result[p * rows + row] = sum[row];
    panel += static_cast<std::ptrdiff_t>(columns) * rows;
  }
}

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
  multiply_panels(triangle.panels.data(), x, (std::min(count, triangle.size) + rows - 1) / rows,
                  triangle.size, result);
}

}  // namespace gait
