// What differs from cycle to cycle: one standard number per component and one for the duration,
// drawn anew for each cycle (T10 §7.1).
//
// Eq. 2 with its limit in one draw: the next number comes from the normal distribution truncated to
// the last one plus or minus the limit. Such a chain is reversible, and its density at rest is
// proportional to phi(z) (Phi(z + L) - Phi(z - L)) for a limit of L deviations.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "gait/play/cycles/random_stream.h"

namespace gait {

// Bounds of one number, in deviations from its mean.
struct DrawBounds {
  double limit = 16;  // largest change from one cycle to the next
  double lowest = -8, highest = 8;
};

class CycleDraws {
 public:
  CycleDraws(int count, std::uint64_t seed);

  void seed(std::uint64_t seed) noexcept { seed_ = seed, rewind(); }
  void rewind() noexcept { random_ = RandomStream(seed_); }  // the same numbers once more

  // Numbers of one cycle may go together: their uniforms come from correlated normals (a Gaussian
  // copula), which leaves each number's own chain what it was. Takes the next of these, number i;
  // `row` is row i of a Cholesky factor of the correlations, i + 1 entries, of any length.
  double uniform(int i, const Eigen::VectorXf& row) noexcept;

  // Draws number i of the next cycle.
  void draw(int i, double uniform, const DrawBounds& bounds) noexcept;
  // The same without a cycle before it: from the density at rest.
  void draw_first(int i, const DrawBounds& bounds) noexcept;
  void turn_over() noexcept;  // the next cycle becomes the current one

  const Eigen::VectorXf& current() const noexcept { return current_; }
  const Eigen::VectorXf& next() const noexcept { return next_; }

 private:
  std::uint64_t seed_;
  RandomStream random_;
  Eigen::VectorXf current_, next_;
  Eigen::VectorXf normals_;  // behind the uniforms of this cycle
};

}  // namespace gait
