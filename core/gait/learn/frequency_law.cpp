#include "gait/learn/frequency_law.h"

#include <cmath>
#include <string>

#include "gait/error.h"

namespace gait {

double FrequencyLaw::at(double speed_per_leg) const {
  return speed_per_leg > 0 ? scale * std::pow(speed_per_leg, power) : 0.0;
}

FrequencyLaw fit_frequency_law(std::span<const CadencePoint> points,
                               const std::optional<LawBefore>& before) {
  if (points.empty()) throw Error("frequency law: expected at least one cycle; found none");
  double mean_x = 0, mean_y = 0;
  for (const CadencePoint& point : points) {
    if (!(point.speed_per_leg > 0) || !(point.frequency > 0) ||
        !std::isfinite(point.speed_per_leg) || !std::isfinite(point.frequency))
      throw Error("frequency law: expected positive speeds and frequencies; found V = " +
                  std::to_string(point.speed_per_leg) + " at " + std::to_string(point.frequency) +
                  " Hz");
    mean_x += std::log(point.speed_per_leg);
    mean_y += std::log(point.frequency);
  }
  mean_x /= static_cast<double>(points.size());
  mean_y /= static_cast<double>(points.size());

  double xx = 0, xy = 0;
  for (const CadencePoint& point : points) {
    const double x = std::log(point.speed_per_leg) - mean_x;
    xx += x * x;
    xy += x * (std::log(point.frequency) - mean_y);
  }
  if (before) {
    xx += before->weight;
    xy += before->weight * before->law.power;
  }
  if (!(xx > 1e-9))
    throw Error("frequency law: expected cycles of more than one speed; all are at V = " +
                std::to_string(std::exp(mean_x)));
  FrequencyLaw law;
  law.power = xy / xx;
  law.scale = std::exp(mean_y - law.power * mean_x);
  return law;
}

}  // namespace gait
