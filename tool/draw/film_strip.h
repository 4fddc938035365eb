// A page of film strips: one row of stick figures per clip, with the ground, where the feet first
// touch, and how far or how long.
#pragma once

#include <filesystem>
#include <vector>

#include "draw/walk_view.h"

namespace gait::tool {

// Writes one row per view, .svg or .png as `path` ends. `strobe` and `compared` as lay_out_row has
// them. Throws Error when it cannot be written.
void write_film_strip(const std::vector<WalkView>& views, const WalkView* compared, int strobe,
                      const std::filesystem::path& path);

}  // namespace gait::tool
