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

// Prior of a frequency law: the fitted power moves from `law` to that of the points as their sum of
// squared deviations of log V outweighs `weight`. Points of nearly equal speed hardly determine the
// power.
struct LawBefore {
  FrequencyLaw law;
  double weight = 0.3;
};

// f = scale * V^power by least squares on log f over log V. Throws Error when there is no point, a
// value is not positive, or the power is undetermined: all V are equal and there is no prior.
FrequencyLaw fit_frequency_law(std::span<const CadencePoint> points,
                               const std::optional<LawBefore>& before = {});

}  // namespace gait
