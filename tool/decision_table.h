// What was decided about each frame of a clip, as a CSV table.
#pragma once

#include <filesystem>

#include "gait/offline/reconstructed_clip.h"

namespace gait::tool {

// A row per frame: time (s), step, state (counted from 0 within the step), log-likelihood, phase
// (0 to 1), cadence (steps per second), then each style's posterior. `first_row`: of the file,
// which is frame 0. Throws Error when it cannot be written.
void write_decisions(const ReconstructedClip& walk, const Model& model,
                     const std::filesystem::path& path, int first_row = 0);

}  // namespace gait::tool
