// What [gait.train] learns on the worker: a model from takes, and how good it is.
#pragma once

#include <atomic>
#include <string>

#include "gait/cancel.h"
#include "gait/teach/takes.h"
#include "pd/models.h"
#include "train_recorder.h"

namespace gait::pd {

struct LearningTask {
  TakeRecorder::Takes takes;
  std::string name;  // of the model
  SharedModel base;  // learn walks of the body of this model; null: learn any values
};

// What the worker and the box share while the worker learns.
struct LearningProgress {
  std::atomic<float> share{0};  // done of the whole, 0 to 1
  Cancel cancel;
};

struct LearningResult {
  SharedModel model;
  TakesJudged judged;
};

// Throws Error when nothing can be learnt from the takes, or the learning is cancelled.
LearningResult learn(const LearningTask& task, LearningProgress& progress);

// A sentence on how well takes that were left out were recognised, or their sound was predicted.
// `walks`: the takes are walks; `sounds`: they have outputs.
std::string verdict(const TakesJudged& judged, bool walks, bool sounds);

}  // namespace gait::pd
