#include "gait/judge/walk_model.h"

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
  return task;
}

Selected select_walk_model(const WalkSequences& walks, const SelectionOptions& options,
                           const ModelOrigin& origin) {
  Selected selected = select_model(walking_task(walks), options);
  Model& model = selected.model;
  model.name = origin.name;
  model.body = walks.body;
  model.training.date = origin.date;
  model.training.comment = origin.comment;
  model.training.synthetic = origin.synthetic;
  return selected;
}

}  // namespace gait
