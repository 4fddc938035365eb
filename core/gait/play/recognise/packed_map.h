// Packed affine maps, start + M x: what whitening an observation costs, and nearly all that a frame
// costs; and what follows from it.
//
// Raw pointers, because the kernel is compiled for several instruction sets (design.md, Traps).
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

// The matrix lies in panels of `panel` rows; within a panel, column after column, of a lower
// triangle up to the panel's last row. Rows beyond the last are zero. A column fills a cache line.
class PackedMap {
 public:
  static constexpr int panel = 16;  // rows
  // Room for so many numbers in whole panels.
  static constexpr int padded(int size) { return (size + panel - 1) / panel * panel; }

  enum class Shape { lower, full };

  PackedMap() = default;
  // `start`: as long as a column.
  PackedMap(const Eigen::Ref<const Eigen::MatrixXd>& matrix,
            const Eigen::Ref<const Eigen::VectorXd>& start, Shape shape);

  // result = start + M x from the leading `count` entries of x: of a lower triangle the leading
  // `count` rows, otherwise all rows. `result` has room for whole panels; so has `x`, and what it
  // holds beyond `count` is finite. Both aligned as you like. Returns the sum of the rows' squares.
  float apply(const float* x, int count, float* result) const noexcept;

  int rows() const noexcept { return rows_; }
  bool operator==(const PackedMap&) const = default;

 private:
  Shape shape_ = Shape::lower;
  int rows_ = 0, columns_ = 0;
  std::vector<float, CacheLineAllocator<float>> panels_, start_;
};

// The panels to multiply: panel p with its leading `columns` + p * `growth` columns, at most
// `most`, the next one `stored` columns further or behind those.
struct PanelProduct {
  const float* panels;
  const float* start;
  int count, columns, growth, most, stored;
  int rows;  // whose squares are summed up
};

// The same product for each set of instructions that this processor has, widest first. apply()
// takes the first, or the one that the environment variable GAIT_KERNEL names when the library is
// loaded (avx512, avx2, portable), so that tests can try them all.
struct PanelKernel {
  std::string_view name;
  float (*multiply)(const PanelProduct& product, const float* x, float* result) noexcept;
};
std::span<const PanelKernel> panel_kernels() noexcept;
// The one that apply() takes.
const PanelKernel& panel_kernel() noexcept;
void use_panel_kernel(const PanelKernel& kernel) noexcept;  // for tests and benchmarks

}  // namespace gait
