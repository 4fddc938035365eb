#include "gait/play/synthesise/step_tables.h"

#include <algorithm>

#include "gait/error.h"
#include "gait/play/synthesise/label_durations.h"

namespace gait {

namespace {

void set_durations(StepTables& tables, const Model& model) {
  tables.durations.resize(tables.labels(), tables.styles);
  tables.can_walk.assign(tables.styles, true);
  for (int label = 0; label < tables.labels(); ++label) {
    const Label& learnt = model.labels[label];
    for (int style = 0; style < tables.styles; ++style) {
      const double own =
          learnt.style_durations.size() == tables.styles ? learnt.style_durations[style] : 0;
      tables.durations(label, style) =
          std::max(LabelDurations::shortest, static_cast<float>(own > 0 ? own : learnt.duration));
      if (!model.styles.empty() && !(own > 0)) tables.can_walk[style] = false;
    }
  }
  if (!std::ranges::count(tables.can_walk, true)) tables.can_walk.assign(tables.styles, true);
}

void add_label(StepTables& tables, const Label& label, int index) {
  double whole = 0, before = 0;
  for (const State& state : label.states) whole += state.duration;
  for (const State& state : label.states) {
    WalkedState walked;
    walked.label = index;
    const double share =
        whole > 0 ? state.duration / whole : 1.0 / static_cast<double>(label.states.size());
    walked.begin = static_cast<float>(before);
    walked.centre = static_cast<float>(before + 0.5 * share);
    before += share;
    walked.means = state.trajectory_means.cast<float>();
    walked.variances = state.trajectory_variances.cast<float>();
    tables.states.push_back(std::move(walked));
  }
}

}  // namespace

bool StepTables::same_sizes(const StepTables& other) const {
  return values == other.values && styles == other.styles && first_state == other.first_state &&
         successors == other.successors && can_walk == other.can_walk &&
         modelled == other.modelled && mean.size() == other.mean.size();
}

std::shared_ptr<const StepTables> make_step_tables(const Model& model) {
  if (model.input_mean.size() == 0)
    throw Error("model " + model.name +
                ": expected trajectory statistics for the step walker; it was learnt without any: "
                "train it again");
  auto tables = std::make_shared<StepTables>();
  tables->values = model.trajectory_values();
  tables->styles = std::max(1, static_cast<int>(model.styles.size()));
  for (const Label& label : model.labels) tables->successors.push_back(label.successors);
  set_durations(*tables, model);

  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(tables->values, tables->styles);
  double all_seconds = 0;
  for (int label = 0; label < tables->labels(); ++label) {
    tables->first_state.push_back(static_cast<int>(tables->states.size()));
    add_label(*tables, model.labels[label], label);
    for (const State& state : model.labels[label].states) {
      const double seconds = std::max(state.duration, 1e-6);
      sums += seconds * state.trajectory_means.topRows(tables->values);
      all_seconds += seconds;
    }
  }
  tables->first_state.push_back(static_cast<int>(tables->states.size()));
  tables->style_means = (sums / all_seconds).cast<float>();

  tables->modelled = model.input.modelled;
  for (const int value : model.output.modelled)
    tables->modelled.push_back(model.input.values + value);
  tables->mean.resize(model.input.values + model.output.values);
  tables->mean << model.input_mean.cast<float>(), model.output_mean.cast<float>();
  return tables;
}

}  // namespace gait
