#include "walking_models.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "gait/corpus/corpus.h"
#include "gait/learn/trainer.h"
#include "gait/model/model_file.h"
#include "gait/teach/walk_model.h"
#include "gait/teach/walks_over_speed.h"

namespace gait::testing {

namespace {

std::string learnt(const std::string& name, bool styles, bool speeds) {
  std::vector<Walk> walks;
  const auto add = [&](CorpusWalk walk) {
    walks.push_back({std::move(walk.clip), walk.style, walk.subject, {}, std::move(walk.contacts)});
  };
  for (const char* style : {"proud", "sad"})
    for (int take = 1; styles && take <= 3; ++take) {
      WalkPlan plan{.style = corpus_style(style)};
      plan.take = take;
      add(make_walk(plan));
    }
  if (speeds)
    for (CorpusWalk& walk : make_speed_walks()) add(std::move(walk));
  const WalkSequences sequences = walk_sequences(walks, {});
  LearningOptions options;
  options.states = 3;
  Model model = learn(walking_task(sequences), options).model;
  model.name = name;
  model.body = sequences.body;
  add_style_space(model, walks);
  add_speed_spaces(model, walks);
  const std::string path = ::testing::TempDir() + "gait_tool_" + name + ".gait";
  write_model(model, path);
  return path;
}

}  // namespace

std::string walking_model() {
  static const std::string path = learnt("walking", true, true);
  return path;
}
std::string styled_model() {
  static const std::string path = learnt("styled", true, false);
  return path;
}
std::string speed_model() {
  static const std::string path = learnt("speeds", false, true);
  return path;
}

}  // namespace gait::testing
