// Falling in step: a walker that walks alone slows down or hurries until its phase is that of the
// recognised walk, so that a hand-over to that walk does not drag feet along.
#pragma once

#include "gait/play/synthesise/step_walker.h"

namespace gait {

// The hand-over begins after this time even when the phases still differ.
inline constexpr double step_patience_seconds = 2;

// True when `walker` is in step with a walk at this phase and cadence (labels per second); else
// sets the walker's pace such that it will be.
bool fall_in_step(StepWalker& walker, float phase, float cadence) noexcept;

}  // namespace gait
