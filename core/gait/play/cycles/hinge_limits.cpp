#include "gait/play/cycles/hinge_limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gait {

namespace {

constexpr float widest_soft = 0.04f;  // rad to either side of a limit

// What is left of the distance from a limit, above 0: within.
float softened(float distance, float soft) noexcept {
  const float into = std::max(0.0f, distance + soft);
  return distance >= soft ? distance : into * into / (4 * soft);
}

// By how much an angle is to change.
float excess(float angle, float least, float most) noexcept {
  const float soft = std::max(1e-6f, std::min(widest_soft, (most - least) / 4));
  const float middle = 0.5f * (least + most);
  // Turned through the back, it goes to the nearer limit.
  const float turned = middle + std::remainder(angle - middle, 2 * std::numbers::pi_v<float>);
  if (turned < least + soft) return least + softened(turned - least, soft) - turned;
  if (turned > most - soft) return most - softened(most - turned, soft) - turned;
  return 0;
}

}  // namespace

void HingeLimits::apply(std::span<Eigen::Quaternionf> pose) const noexcept {
  for (const Hinge& hinge : hinges_) {
    const Eigen::Vector3f axis = hinge.axis.cast<float>();
    const float angle =
        hinge_bones<float>(skeleton_, hinge, std::span<const Eigen::Quaternionf>(pose)).angle(axis);
    const float by = excess(angle, static_cast<float>(hinge.least), static_cast<float>(hinge.most));
    if (by == 0) continue;
    Eigen::Quaternionf& joint = pose[static_cast<std::size_t>(hinge.joint)];
    joint = (Eigen::Quaternionf(Eigen::AngleAxisf(by, axis)) * joint).normalized();
  }
}

}  // namespace gait
