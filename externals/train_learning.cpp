#include "train_learning.h"

#include <cstdio>
#include <vector>

#include "gait/teach/walk_takes.h"

namespace gait::pd {

LearningResult learn(const LearningTask& task, LearningProgress& progress) {
  TakeOptions options;
  options.cancel = progress.cancel;
  options.progress = [&](double share, const std::string&) {
    progress.share = static_cast<float>(share);
  };
  TakesLearnt learnt;
  if (task.base) {
    std::vector<RecordedTake> recorded;
    for (const auto& take : task.takes) recorded.push_back(*take);
    learnt = learn_walk_takes(recorded, *task.base->model->body, task.name, options);
  } else {
    std::vector<Take> even;
    for (const auto& take : task.takes) even.push_back(at_rate(*take, options.frame_rate));
    learnt = learn_takes(even, options);
    learnt.model.name = task.name;
  }
  return {make_play_model(std::move(learnt.model)), learnt.judged};
}

std::string verdict(const TakesJudged& judged, bool walks, bool sounds) {
  if (judged.takes == 0) return "learnt; with two takes of each it could say how good it is";
  char text[200];
  if (sounds)
    std::snprintf(text, sizeof text,
                  "when a take was left out, what sounds was off by %.2f of its deviation%s",
                  judged.error,
                  judged.error <= 0.25  ? ": good"
                  : judged.error <= 0.6 ? ": more takes would help"
                                        : ": it hardly follows from what moves");
  else
    std::snprintf(text, sizeof text, "%s recognised %.0f of 100 times when it was left out%s",
                  walks ? "a step was" : "a take was", 100 * judged.accuracy,
                  judged.accuracy >= 0.95  ? ": good"
                  : judged.accuracy >= 0.8 ? ": more takes would help"
                                           : ": some of these are too much alike, or takes differ "
                                             "too much");
  return text;
}

}  // namespace gait::pd
