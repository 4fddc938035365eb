// Packed lower-triangular matrices and their product with a vector: what whitening an observation
// costs, and nearly all a frame costs.
//
// Raw pointers, because the kernel is compiled for several instruction sets (docs/design.md,
// Traps).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace gait {

// A lower triangle in panels of `rows` rows; within a panel, column after column, up to the panel's
// last row. Rows beyond the size are zero.
struct PackedTriangle {
  static constexpr int rows = 16;
  int size = 0;
  std::vector<float> panels;

  PackedTriangle() = default;
  explicit PackedTriangle(const Eigen::Ref<const Eigen::MatrixXd>& lower);
  // Room that a product needs: size rounded up to whole panels.
  int padded() const { return (size + rows - 1) / rows * rows; }
};

// result = leading `count` rows of the triangle times x. `x` holds at least as many entries as a
// whole number of panels reaches, finite beyond `count`; `result` too. Both aligned as you like.
void multiply(const PackedTriangle& triangle, const float* x, int count, float* result) noexcept;

}  // namespace gait
