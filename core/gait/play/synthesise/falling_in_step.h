// Falling in step: who walks alone waits or hurries until they are where somebody else is in their
// cycle, so that motion can go over to the other's without dragging feet along.
#pragma once

#include "gait/play/synthesise/step_walker.h"

namespace gait {

// However the phases lie, nobody waits longer than this for the other.
inline constexpr double step_patience_seconds = 2;

// True when `walker` is in step with somebody at this phase and cadence (labels per second); else
// sets its pace so that it will be.
bool fall_in_step(StepWalker& walker, float phase, float cadence) noexcept;

}  // namespace gait
