// Cycles of labels: labels that follow each other in a ring by single successors, as the steps of a
// walk do, share the cycle evenly. A label outside any ring is a cycle of its own.
#pragma once

#include <vector>

#include "gait/model/model.h"

namespace gait {

// The cycle that a label belongs to, and the label's place in it.
struct LabelCycle {
  int ring = 0;         // the first label of the cycle
  int index = 0;        // labels from there
  int labels = 1;       // in the cycle
  float frequency = 0;  // cycles per second at the model's mean durations; 0 where it has none

  // Phase at which the label begins, 0 to 1.
  float begin() const noexcept { return static_cast<float>(index) / static_cast<float>(labels); }
  // Labels per second at the model's mean durations.
  float cadence() const noexcept { return frequency * static_cast<float>(labels); }
};

// Seconds that a label lasts by the mean durations of its states.
double mean_duration(const Label& label);

// One per label.
std::vector<LabelCycle> label_cycles(const Model& model);

}  // namespace gait
