#include "gait/model/label_cycle.h"

namespace gait {

double mean_duration(const Label& label) {
  double seconds = 0;
  for (const State& state : label.states) seconds += state.duration;
  return seconds;
}

std::vector<LabelCycle> label_cycles(const Model& model) {
  const int count = static_cast<int>(model.labels.size());
  std::vector<LabelCycle> cycles;
  for (int label = 0; label < count; ++label) {
    LabelCycle cycle{label};
    int first = label, length = 0, labels_to_first = 0, at = label;
    double seconds = 0;
    // More labels than there are: the way from this label never comes back to it.
    while (length <= count && model.labels[at].successors.size() == 1) {
      seconds += mean_duration(model.labels[at]);
      at = model.labels[at].successors.front();
      ++length;
      if (at == label) break;
      if (at < first) first = at, labels_to_first = length;
    }
    if (at == label && length > 0)
      cycle = {first, (length - labels_to_first) % length, length};
    else
      seconds = mean_duration(model.labels[label]);
    cycle.frequency = seconds > 0 ? static_cast<float>(1 / seconds) : 0.0f;
    cycles.push_back(cycle);
  }
  return cycles;
}

}  // namespace gait
