#include "gait/judge/stream_summary.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

std::vector<StreamSummary> summaries(const std::vector<Stream>& streams,
                                     const std::vector<int>& modelled, const Scaling& scaling) {
  std::vector<StreamSummary> result;
  int begin = 0;
  for (const Stream& stream : streams) {
    StreamSummary summary{stream.name, stream.size, 0, 0};
    double variance = 0;
    for (std::size_t i = 0; i < modelled.size(); ++i) {
      if (modelled[i] < begin || modelled[i] >= begin + stream.size) continue;
      const double deviation = scaling.deviation[static_cast<Eigen::Index>(i)];
      variance += deviation * deviation;
      ++summary.moving;
    }
    summary.deviation = std::sqrt(variance);
    begin += stream.size;
    result.push_back(std::move(summary));
  }
  return result;
}

}  // namespace

std::vector<StreamSummary> summaries_of_inputs(const Model& model) {
  return summaries(model.inputs, model.input.modelled, model.input_scaling);
}

std::vector<StreamSummary> summaries_of_outputs(const Model& model) {
  return summaries(model.outputs, model.output.modelled, model.output_scaling);
}

bool has_trajectories(const Model& model) {
  return std::all_of(model.labels.begin(), model.labels.end(), [](const Label& label) {
    return std::all_of(label.states.begin(), label.states.end(),
                       [](const State& state) { return state.trajectory_means.size() > 0; });
  });
}

}  // namespace gait
