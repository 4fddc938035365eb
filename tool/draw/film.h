// A film of walking stick figures, side by side, each followed by its own camera.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "draw/walk_view.h"

namespace gait::tool {

// `compared`: drawn in grey behind the only figure; may be null. `progress`: called with the share
// done. Throws Error when ffmpeg is missing or fails.
void write_film(const std::vector<WalkView>& views, const WalkView* compared,
                const std::filesystem::path& path, const std::function<void(double)>& progress);

}  // namespace gait::tool
