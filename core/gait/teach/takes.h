// Learning from takes of anything that moves: gestures with a label each, or one motion beside the
// parameters that sounded meanwhile (T14's mapping by demonstration, Hueber et al. 2012). Streams
// are plain values in their own units; nothing here speaks of feet.
//
// A take is one phrase: left to right through the states of its label; any label may follow any.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gait/cancel.h"
#include "gait/judge/model_selection.h"

namespace gait {

struct Take {
  std::string label;
  Eigen::MatrixXd inputs;   // values by frames, at the task's frame rate
  Eigen::MatrixXd outputs;  // as many frames, or no rows: then it is the inputs that are mapped to
};

struct TakeOptions {
  double frame_rate = 30;
  int threads = 0;  // as many as the machine has
  std::function<void(double share, const std::string& what)> progress;
  Cancel cancel;
};

// How a model does on takes that it has not seen, each left out with others of its fold.
struct TakesJudged {
  double accuracy = 0;  // share of takes whose label led in most of their frames
  double error = 0;  // of outputs, mean absolute difference by their deviation; 0 without outputs
  int takes = 0;     // that could be judged
};

struct TakesLearnt {
  Model model;
  TakesJudged judged;
};

// Throws Error when there are no takes, when they differ in their values, when one is too short
// (named with its number, from 0, and label), when no input moves, or Error("cancelled").
TakesLearnt learn_takes(const std::vector<Take>& takes, const TakeOptions& options = {});

}  // namespace gait
