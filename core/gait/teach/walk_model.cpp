#include "gait/teach/walk_model.h"

#include <algorithm>

#include "gait/error.h"
#include "gait/learn/cycles.h"
#include "gait/learn/style_space.h"
#include "gait/teach/walks_over_speed.h"

namespace gait {

LearningTask walking_task(const WalkSequences& walks) {
  LearningTask task;
  task.frame_rate = walks.frame_rate;
  task.inputs = walks.inputs;
  task.outputs = walks.outputs;
  task.labels = {{std::string(foot_name(Foot::right)), {1}},
                 {std::string(foot_name(Foot::left)), {0}}};
  task.styles = walks.styles;
  task.sequences = walks.sequences;
  task.body = walks.body;
  return task;
}

Selected select_walk_model(const WalkSequences& walks, const SelectionOptions& options,
                           const ModelOrigin& origin) {
  Selected selected = select_model(walking_task(walks), options);
  Model& model = selected.model;
  model.name = origin.name;
  model.training.date = origin.date;
  model.training.comment = origin.comment;
  model.training.synthetic = origin.synthetic;
  return selected;
}

void add_style_space(Model& model, const std::vector<Walk>& walks, const StyleSpaceOptions& options,
                     const RoleTable& roles) {
  model.style_space.reset();
  if (model.styles.empty() || !model.body) return;
  std::vector<int> style_of_walk;
  for (const Walk& walk : walks) {
    const auto known = std::find(model.styles.begin(), model.styles.end(), walk.style);
    style_of_walk.push_back(
        known == model.styles.end() ? -1 : static_cast<int>(known - model.styles.begin()));
  }
  const std::vector<CapturedCycle> cycles = cut_cycles(walks, *model.body, options.frames, roles);
  const auto usable = std::count_if(cycles.begin(), cycles.end(), [&](const CapturedCycle& cycle) {
    return cycle.straight && style_of_walk[cycle.walk] >= 0;
  });
  if (usable < 2) return;
  model.style_space =
      learn_style_space(cycles, style_of_walk, static_cast<int>(model.styles.size()),
                        joints_below_hips(*model.body), options.frames, options.components);
}

LearntWalks learn_walks(const std::vector<Walk>& walks, const std::vector<Walk>& over_speed,
                        const WalkOptions& options, const SelectionOptions& selection,
                        const ModelOrigin& origin) {
  const auto check_cancel = [&] {
    if (selection.learning.hmm.cancel.requested()) throw Error("cancelled");
  };
  LearntWalks learnt;
  WalkOptions walk_options = options;
  walk_options.history = selection.learning.history.empty() ? 0 : selection.learning.history.back();
  learnt.sequences = walk_sequences(walks, walk_options);
  check_cancel();
  learnt.selected = select_walk_model(learnt.sequences, selection, origin);
  Model& model = learnt.selected.model;
  add_style_space(model, walks, {}, options.roles);
  check_cancel();
  SpeedOptions speeds;
  speeds.roles = options.roles;
  add_speed_spaces(model, over_speed, speeds);
  check_cancel();
  return learnt;
}

}  // namespace gait
