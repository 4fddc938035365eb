// Phase from a decision: how far through the cycle of labels the decided frame is, 0 to 1.
//
// Cycles are those of model/label_cycle.h: the steps of a walk are right = [0, 0.5), left = [0.5,
// 1). Within a label the mean durations of its states say how far it is (docs/design.md, Progress).
//
// A decision rests on the pose and on differences to poses some frames back. A difference over d
// seconds speaks of the moment d/2 ago, so who walks faster than the model's mean is seen too early
// in the cycle, and who walks slower too late: by (frequency - mean frequency) times the mean age
// of what is observed. (Measured on held-out walks: 40 to 85 ms; by this reckoning 67 ms.) An
// estimate therefore also says which phase was seen at that earlier moment, which is right at any
// cadence. Models that learnt how the phase goes with the observation say it from that
// (State::phase); it is half as far off (docs/design.md, Phase).
#pragma once

#include <span>
#include <vector>

#include "gait/model/label_cycle.h"
#include "gait/model/model.h"
#include "gait/play/recognise/decoder.h"

namespace gait {

struct PhaseEstimate {
  float phase = 0;      // of the decided frame, were it walked at the model's mean cadence; 0 to 1
  float certainty = 0;  // 0 to 1; 1: all weight on one phase
  float seen = 0;       // phase `age` seconds before the decided frame, at any cadence
  float age = 0;        // seconds
};

class PhaseEstimator {
 public:
  explicit PhaseEstimator(const Model& model);

  // `states`: of a decision, the likeliest first; `progress`: through the first one's label. One
  // state speaks by its progress; several by the circular mean of where they lie in the cycle.
  PhaseEstimate of(std::span<const WeightedState> states, float progress) const noexcept;
  // The same, with what was seen from the observation itself: `seen`, one phase per state, in
  // cycles.
  PhaseEstimate of(std::span<const WeightedState> states, float progress,
                   std::span<const float> seen) const noexcept;

  const LabelCycle& cycle(int label) const noexcept { return cycles_[label]; }

 private:
  struct Mean {
    float phase = 0, certainty = 0;
  };
  Mean mean_of(std::span<const WeightedState> states, auto phase_of) const noexcept;
  PhaseEstimate estimate(const LabelCycle& cycle, float phase, float certainty) const noexcept;

  std::vector<LabelCycle> cycles_;  // per label
  std::vector<int> label_of_;       // per state
  std::vector<float> middle_;       // per state: cycles
  float age_ = 0;                   // mean age of what is observed, seconds
};

}  // namespace gait
