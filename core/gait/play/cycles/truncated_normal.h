// The standard normal distribution and what is left of it between two bounds, drawn by its inverse
// distribution function: one number in, one out, always the same time.
#pragma once

namespace gait {

// Distribution function, exact to the last digits in the lower tail.
double normal_distribution(double x) noexcept;

// The x at which the distribution function is `probability` (clamped to where x is within +-37).
double normal_quantile(double probability) noexcept;

// The number at `uniform`, 0..1, of the standard normal distribution between `lowest` and
// `highest`. Never outside the bounds; where lowest >= highest, halfway between them. The mass
// between far tails is taken on the lower side, where nothing cancels.
double truncated_normal(double uniform, double lowest, double highest) noexcept;

}  // namespace gait
