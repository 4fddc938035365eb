// From sequences to a model: observations, states, durations, styles.
#pragma once

#include <string>
#include <vector>

#include "gait/learn/hmm_trainer.h"
#include "gait/learn/observed.h"
#include "gait/model/model.h"

namespace gait {

// A label to be learnt.
struct LabelPlan {
  std::string name;
  std::vector<int> successors;  // indices of the labels that may follow
};

struct LearningTask {
  double frame_rate = 30;
  std::vector<Stream> inputs, outputs;
  std::vector<LabelPlan> labels;
  std::vector<std::string> styles;
  std::vector<Sequence> sequences;
};

struct LearningOptions {
  int states = 8;                                              // per label
  std::vector<double> history{1.0 / 30, 5.0 / 30, 10.0 / 30};  // seconds back of input differences
  // Radians by which a joint's sensor may sit or be calibrated otherwise than when it was learnt
  // from; part of steps' and styles' covariances.
  double placement = 0;
  HmmOptions hmm;
};

// All that learning knows at its end: the model, and what is needed to learn it again from a part
// of the data.
struct Learnt {
  Model model;
  ObservationSet observed;
  StateTable table{{}};
  TrainedStates states;
};

// Throws Error when there is nothing to learn from.
Learnt learn(const LearningTask& task, const LearningOptions& options);

// Puts states into a model from statistics: means, regularised covariances (with a quiet sensor's
// variance and that of its placement), styles. `statistics`, `stay`: per state of all labels;
// `target`: T's diagonal, over z.
void set_states(Model& model, const StateTable& table,
                const std::vector<StateStatistics>& statistics, const std::vector<double>& stay,
                const Eigen::VectorXd& target, double regularisation, double placement);

}  // namespace gait
