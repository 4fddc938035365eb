// Phase from a decision: how far through the cycle of labels the decided frame is, 0 to 1.
//
// Labels that follow each other in a ring by single successors share the cycle evenly: the steps of
// a walk are right = [0, 0.5), left = [0.5, 1). A label outside any ring is a cycle of its own.
// Within a label the mean durations of its states say how far it is (design.md, Progress).
//
// A decision rests on the pose and on differences to poses some frames back. A difference over d
// seconds speaks of the moment d/2 ago, so who walks faster than the model's mean is seen too early
// in the cycle, and who walks slower too late: by (frequency - mean frequency) times the mean age
// of what is observed. (Measured on held-out walks: 40 to 85 ms; by this reckoning 67 ms.) An
// estimate therefore also says which phase was seen at that earlier moment, which is right at any
// cadence.
#pragma once

#include <span>
#include <vector>

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

  // Labels in the cycle that `label` belongs to: its i-th begins at phase i over that.
  int labels_in_cycle(int label) const noexcept { return places_[label].of; }
  // Labels per second at the model's mean, in that cycle.
  float mean_cadence(int label) const noexcept {
    return places_[label].frequency * static_cast<float>(places_[label].of);
  }

 private:
  struct Place {          // of a label in its ring
    int ring = 0;         // the first label of the ring
    int index = 0;        // labels from there
    int of = 1;           // labels in the ring
    float frequency = 0;  // mean cycles/s
  };
  PhaseEstimate estimate(const Place& place, float phase, float certainty) const noexcept;

  std::vector<Place> places_;
  std::vector<int> label_of_;  // per state
  std::vector<float> middle_;  // per state: cycles
  float age_ = 0;              // mean age of what is observed, seconds
};

}  // namespace gait
