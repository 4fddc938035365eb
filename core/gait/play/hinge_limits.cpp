#include "gait/play/hinge_limits.h"

#include <algorithm>

namespace gait {

namespace {

constexpr float soft = 0.04f;  // rad to either side of a limit

// What is left of the distance from a limit, above 0: within.
float softened(float distance) noexcept {
  if (distance >= soft) return distance;
  const float into = std::max(0.0f, distance + soft);
  return into * into / (4 * soft);
}

float limited(float angle, float least, float most) noexcept {
  const float middle = 0.5f * (least + most);
  return angle < middle ? std::min(middle, least + softened(angle - least))
                        : std::max(middle, most - softened(most - angle));
}

}  // namespace

void HingeLimits::apply(std::span<Eigen::Quaternionf> pose) const noexcept {
  for (const Hinge& hinge : hinges_) {
    const Eigen::Vector3f axis = hinge.axis.cast<float>();
    const float angle =
        hinge_bones<float>(skeleton_, hinge, std::span<const Eigen::Quaternionf>(pose)).angle(axis);
    const float within =
        limited(angle, static_cast<float>(hinge.least), static_cast<float>(hinge.most));
    if (within == angle) continue;
    Eigen::Quaternionf& joint = pose[static_cast<std::size_t>(hinge.joint)];
    joint = (Eigen::Quaternionf(Eigen::AngleAxisf(within - angle, axis)) * joint).normalized();
  }
}

}  // namespace gait
