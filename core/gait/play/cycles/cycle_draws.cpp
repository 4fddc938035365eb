#include "gait/play/cycles/cycle_draws.h"

#include <algorithm>

#include "gait/play/cycles/truncated_normal.h"

namespace gait {

namespace {

// The share of the normal distribution that a cycle may go on to.
double reach(double z, const DrawBounds& bounds) noexcept {
  return normal_distribution(std::min(z + bounds.limit, bounds.highest)) -
         normal_distribution(std::max(z - bounds.limit, bounds.lowest));
}

}  // namespace

CycleDraws::CycleDraws(int count, std::uint64_t seed)
    : seed_(seed),
      random_(seed),
      current_(Eigen::VectorXf::Zero(count)),
      next_(current_),
      normals_(current_) {}

double CycleDraws::uniform(int i, const Eigen::VectorXf& row) noexcept {
  normals_[i] = static_cast<float>(normal_quantile(random_.uniform()));
  const double length = row.head(i + 1).norm();
  return normal_distribution(row.head(i + 1).dot(normals_.head(i + 1)) / length);
}

void CycleDraws::draw(int i, double uniform, const DrawBounds& bounds) noexcept {
  const double last = std::clamp<double>(current_[i], bounds.lowest, bounds.highest);
  next_[i] =
      static_cast<float>(truncated_normal(uniform, std::max(last - bounds.limit, bounds.lowest),
                                          std::min(last + bounds.limit, bounds.highest)));
}

void CycleDraws::draw_first(int i, const DrawBounds& bounds) noexcept {
  // Rejection: reach is largest where the way to both sides is free, as near to 0 as can be, and on
  // average well over half of that.
  const double first = bounds.lowest + bounds.limit, last = bounds.highest - bounds.limit;
  const double most = reach(
      first < last ? std::clamp(0.0, first, last) : 0.5 * (bounds.lowest + bounds.highest), bounds);
  constexpr int tries = 64;
  double z = 0;
  for (int n = 0; n < tries; ++n) {
    z = truncated_normal(random_.uniform(), bounds.lowest, bounds.highest);
    if (random_.uniform() * most <= reach(z, bounds)) break;
  }
  next_[i] = static_cast<float>(z);
}

void CycleDraws::turn_over() noexcept { current_ = next_; }

}  // namespace gait
