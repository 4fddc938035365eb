// Frequency law: cycles per second over dimensionless speed V = v / leg length (G04 §4.2, eq. 6).
#pragma once

#include <optional>
#include <span>

namespace gait {

struct FrequencyLaw {
  double scale = 0.743, power = 0.5;  // Inman's (G04 eq. 4)

  double at(double speed_per_leg) const;  // cycles per second; 0 at 0
};

struct CadencePoint {
  double speed_per_leg = 0;  // V
  double frequency = 0;      // cycles per second
};

// What is known of a law before its points: they bend it away from `law` as far as they outweigh
// `weight`, in squared deviations of log V. Points that hardly differ in speed say little of power.
struct LawBefore {
  FrequencyLaw law;
  double weight = 0.3;
};

// f = scale * V^power by least squares on log f over log V. Throws Error when there is no point, a
// value is not positive, or nothing tells the power: all V equal and nothing known before.
FrequencyLaw fit_frequency_law(std::span<const CadencePoint> points,
                               const std::optional<LawBefore>& before = {});

}  // namespace gait
