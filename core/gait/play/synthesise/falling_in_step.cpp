#include "gait/play/synthesise/falling_in_step.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

constexpr float in_step = 0.03f;  // cycles
constexpr float hurry = 4;        // per second: how fast a difference in phase is made good
constexpr float slowest_pace = 0.5f, fastest_pace = 1.25f;

}  // namespace

bool fall_in_step(StepWalker& walker, float phase, float cadence) noexcept {
  const float behind = walker.behind(phase, cadence);
  const float now = std::remainder(phase - walker.phase(), 1.0f);
  if (std::abs(behind) < in_step && std::abs(now) < in_step) return true;
  walker.set_pace(std::clamp(1 + hurry * behind, slowest_pace, fastest_pace));
  return false;
}

}  // namespace gait
