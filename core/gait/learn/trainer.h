// Trainer: learns a model (observations, states, durations, styles) from sequences.
#pragma once

#include <numbers>
#include <optional>
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
  std::optional<Body> body{};  // behind rotation streams
};

struct LearningOptions {
  int states = 8;                                              // per label
  std::vector<double> history{1.0 / 30, 5.0 / 30, 10.0 / 30};  // seconds back of input differences
  // Deviation in radians by which the placement or calibration of a joint's sensor may differ from
  // training; added to the covariances of steps and styles.
  double placement = 0;
  // Of the model of a body: deviations at which observations are clipped, usual distances within
  // which they are trusted, easing of the trajectory. Plain streams go on as they are taught.
  double clip = 3.5, trust = 1.5, easing = 2.5;
  // Deviation in radians of the hips' frame from body to body.
  double hips_frame = 3 * std::numbers::pi / 180;
  HmmOptions hmm;
};

// Result of learning: the model, and the data needed to learn it again from a part of the
// sequences.
struct Learnt {
  Model model;
  ObservationSet observed;
  StateTable table{{}};
  TrainedStates states;
};

// Throws Error when the task holds nothing to learn from.
Learnt learn(const LearningTask& task, const LearningOptions& options);

// Variance that sensors add to each entry of an observation, in the scale of the observation, by
// their noise and by their `placement` (deviation, radians).
Eigen::VectorXd sensor_variance(const Model& model, double placement);

// Sets the states of a model from statistics: means, regularised covariances (plus the variance of
// a sensor's noise and placement), styles. `statistics`, `stay`: per state of all labels; `target`:
// T's diagonal, over z.
void set_states(Model& model, const StateTable& table,
                const std::vector<StateStatistics>& statistics, const std::vector<double>& stay,
                const Eigen::VectorXd& target, double regularisation, double placement);

}  // namespace gait
