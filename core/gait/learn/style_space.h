// Style space: principal components of walk cycles, and the variation of each style's cycles in it
// (T10 §4-6).
#pragma once

#include <vector>

#include "gait/learn/cycles.h"
#include "gait/learn/principal_components.h"
#include "gait/model/cycle_space.h"

namespace gait {

// Fits the components to the first n straight cycles of each style, n being the smallest number of
// them that a style has, then projects all straight cycles. Neighbours are straight cycles that
// follow each other in one walk; a style without any may change by the whole range it was seen in.
// Styles without a straight cycle are left out: they have 0 cycles.
//
// `cycles`: from cut_cycles, all of the same size. `style_of_walk`: per walk an index below
// `styles`, -1 for none. `joints`: those of the cycles (joints_below_hips). Throws Error when fewer
// than two cycles are left.
StyleSpace learn_style_space(const std::vector<CapturedCycle>& cycles,
                             const std::vector<int>& style_of_walk, int styles,
                             const std::vector<int>& joints, int frames,
                             const ComponentChoice& choice = {});

}  // namespace gait
