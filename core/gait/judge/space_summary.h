// How much of what walks differ in lies in how few components (T10 fig. 2; G04 fig. 3, Table 1).
#pragma once

#include <array>
#include <vector>

#include "gait/model/cycle_space.h"

namespace gait {

inline constexpr std::array<double, 4> told_shares{0.80, 0.90, 0.95, 0.99};  // of the variance

struct SpaceSummary {
  int cycles = 0;                 // that the space was fitted to
  int kept = 0;                   // components
  std::array<int, 4> components;  // that carry told_shares
  // Cycles over components that carry each share: by how much they shrink (G04 Table 1).
  std::array<double, 4> reduction;
};

SpaceSummary summary_of(const CycleSpace& space, int cycles);
SpaceSummary summary_of(const StyleSpace& styles);
SpaceSummary summary_of(const SpeedSpace& subject);

// Share of the variance in the first n components, n from 0 to all of them.
std::vector<double> cumulated_shares(const CycleSpace& space);

}  // namespace gait
