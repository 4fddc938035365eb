// A page of one moment of the walk at several speeds and leg lengths (G04 fig. 8): speeds from left
// to right, legs from top to bottom, all at one scale.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gait/model/model.h"

namespace gait::tool {

struct SpeedGrid {
  std::vector<double> speeds;       // m/s
  std::vector<double> leg_lengths;  // metres; none: the model's own
  double camera_degrees = 90;       // around the walker: 0 in front, 90 at the right side
};

// Draws what the speed walker walks, at right contact. Throws Error when the model has no walks
// over speed. What was clamped goes to stderr as warnings of `gait render`.
void write_speed_grid(const std::shared_ptr<const Model>& model, const SpeedGrid& grid,
                      const std::filesystem::path& path);

}  // namespace gait::tool
