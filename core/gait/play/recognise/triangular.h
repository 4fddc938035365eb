// Packed lower-triangular matrices and their product with a vector: what whitening an observation
// costs, and nearly all a frame costs.
//
// Raw pointers, because the kernel is compiled for several instruction sets (docs/design.md,
// Traps).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <new>
#include <span>
#include <string_view>
#include <vector>

namespace gait {

// Memory at the beginning of a cache line: no column of a panel lies in two.
template <typename Value>
struct CacheLineAllocator {
  using value_type = Value;
  static constexpr std::align_val_t line{64};
  CacheLineAllocator() = default;
  template <typename Other>
  CacheLineAllocator(const CacheLineAllocator<Other>&) noexcept {}
  Value* allocate(std::size_t count) {
    return static_cast<Value*>(::operator new(count * sizeof(Value), line));
  }
  void deallocate(Value* values, std::size_t) noexcept { ::operator delete(values, line); }
  bool operator==(const CacheLineAllocator&) const = default;
};

// A lower triangle in panels of `rows` rows; within a panel, column after column, up to the panel's
// last row. Rows beyond the size are zero. A column fills a cache line.
struct PackedTriangle {
  static constexpr int rows = 16;
  int size = 0;
  std::vector<float, CacheLineAllocator<float>> panels;

  PackedTriangle() = default;
  explicit PackedTriangle(const Eigen::Ref<const Eigen::MatrixXd>& lower);
  // Room that a product needs: size rounded up to whole panels.
  int padded() const { return (size + rows - 1) / rows * rows; }
};

// result = leading `count` rows of the triangle times x. `x` holds at least as many entries as a
// whole number of panels reaches, finite beyond `count`; `result` too. Both aligned as you like.
void multiply(const PackedTriangle& triangle, const float* x, int count, float* result) noexcept;

// The same product for each set of instructions that this processor has, widest first. multiply()
// takes the first, or the one that the environment variable GAIT_KERNEL names when the library is
// loaded (avx512, avx2, portable), so that tests can try them all.
struct TriangleKernel {
  std::string_view name;
  // Panels, x, how many panels, size of the triangle, result.
  void (*multiply)(const float*, const float*, int, int, float*) noexcept;
};
std::span<const TriangleKernel> triangle_kernels() noexcept;

}  // namespace gait
