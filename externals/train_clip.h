// Takes from files of motion, as [gait.train]'s `add` reads them.
#pragma once

#include <filesystem>

#include "gait/model/model.h"
#include "gait/teach/takes_file.h"

namespace gait::pd {

// The poses of a clip on the body of this model. The take's label is the file's name without a
// leading `walk_` and a number at its end: `walk_happy_2.bvh` is a take of `happy`. Throws Error.
RecordedTake take_of_clip(const std::filesystem::path& path, const Model& model);

}  // namespace gait::pd
