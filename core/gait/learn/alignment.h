// Alignment: the posterior of each state in each frame, given a sequence's known labels.
//
// The states of a sequence's segments form one chain, left to right without skips. A frame may
// be in a state of its own segment or, near a boundary, of the neighbouring segment: boundaries may
// move by `slack` frames.
#pragma once

#include <vector>

#include "gait/learn/gaussian.h"
#include "gait/learn/sequence.h"

namespace gait {

// States count over all labels, label after label.
struct StateTable {
  std::vector<int> first_state;  // per label
  std::vector<int> states;       // per label
  int total = 0;

  explicit StateTable(const std::vector<int>& states_per_label);
};

struct Occupancy {
  int frame = 0;     // column of the sequence
  int state = 0;     // over all labels
  double share = 0;  // posterior of the state, 0..1
};

struct Alignment {
  std::vector<Occupancy> occupancies;  // frame after frame
  std::vector<double> stays, leaves;   // per state: expected numbers of self and onward transitions
  double log_likelihood = 0;           // of x given the labels (or along the one path)
};

struct EmissionModel {
  std::vector<Gaussian> of_state;  // over x
  std::vector<double> stay;        // self-transition probability
};

// Cuts each segment into equal parts, one per state.
Alignment align_equally(const ObservedSequence& sequence, const StateTable& table);

// Posteriors by forward-backward, or the best path alone (`hard`). A segment that is shorter than
// its number of states extends into its neighbours within the slack; when that is not enough, the
// sequence keeps equal parts.
Alignment align(const ObservedSequence& sequence, const StateTable& table,
                const EmissionModel& emissions, int slack, bool hard);

}  // namespace gait
