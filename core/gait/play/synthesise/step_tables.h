// What the step walker follows: per state the trajectory statistics of all joints, in float, and
// where the states lie within their label.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "gait/model/model.h"

namespace gait {

struct WalkedState {
  int label = 0;
  float begin = 0, centre = 0;  // through its label, 0..1
  Eigen::MatrixXf means;        // 3 * values by styles: statics, first, then second differences
  Eigen::VectorXf variances;    // of the same
};

struct StepTables {
  int values = 0;                   // that move: the inputs', then the outputs'
  int styles = 1;                   // columns; one without styles
  std::vector<WalkedState> states;  // label after label
  std::vector<int> first_state;     // per label, and the end
  std::vector<std::vector<int>> successors;
  Eigen::MatrixXf durations;    // seconds, labels by styles: a style's own, else the label's
  std::vector<bool> can_walk;   // per style: whether it has every label
  Eigen::MatrixXf style_means;  // of the values over all states, by styles
  std::vector<int> modelled;    // where in a frame of all values those that move lie
  Eigen::VectorXf mean;         // of all values: the inputs', then the outputs'

  int labels() const { return static_cast<int>(successors.size()); }
  // Whether a walk through `other` can go on in these.
  bool same_sizes(const StepTables& other) const;
};

// Throws Error when the model has no trajectory statistics.
std::shared_ptr<const StepTables> make_step_tables(const Model& model);

}  // namespace gait
