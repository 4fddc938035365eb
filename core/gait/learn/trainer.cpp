#include "gait/learn/trainer.h"

#include <algorithm>
#include <cmath>

#include "gait/error.h"
#include "gait/learn/phase_statistics.h"
#include "gait/learn/trajectory_statistics.h"

namespace gait {

namespace {

std::vector<int> lags_at(const std::vector<double>& history, double frame_rate) {
  std::vector<int> lags;
  for (const double seconds : history) {
    const int lag = std::max(1, static_cast<int>(std::lround(seconds * frame_rate)));
    if (lags.empty() || lag > lags.back()) lags.push_back(lag);
  }
  return lags;
}

void set_durations(Model& model, const ObservationSet& observed) {
  for (std::size_t i = 0; i < model.labels.size(); ++i) {
    Label& label = model.labels[i];
    std::vector<double> lengths;
    const auto styles = static_cast<Eigen::Index>(model.styles.size());
    label.style_durations = Eigen::VectorXd::Zero(styles);
    Eigen::VectorXd counts = Eigen::VectorXd::Zero(styles);
    for (const ObservedSequence& sequence : observed.sequences)
      for (const Segment& segment : sequence.segments)
        if (segment.label == static_cast<int>(i)) {
          lengths.push_back((segment.end - segment.begin) / model.frame_rate);
          if (sequence.style < 0) continue;
          label.style_durations[sequence.style] += lengths.back();
          counts[sequence.style] += 1;
        }
    label.style_durations.array() /= counts.array().max(1);
    if (lengths.empty())
      throw Error("expected takes of every label; '" + label.name + "' has none");
    const Eigen::Map<Eigen::VectorXd> all(lengths.data(), static_cast<int>(lengths.size()));
    label.duration = all.mean();
    label.duration_deviation = std::sqrt((all.array() - all.mean()).square().mean());
    label.shortest = all.minCoeff();
    label.longest = all.maxCoeff();
  }
}

}  // namespace

// Without it a joint with a constant angle in each style would dominate the recognition of steps
// and styles, and its slightest movement would look like another step or style. Placement adds to
// poses, not to differences.
Eigen::VectorXd sensor_variance(const Model& model, double placement) {
  constexpr double sensor_deviation = 3e-4;  // radians: 0.02 degrees, the quiet of a still suit
  std::vector<bool> turns;                   // per value
  for (const Stream& stream : model.inputs)
    turns.insert(turns.end(), stream.size, stream.kind == StreamKind::rotation);
  const int statics = model.input.statics();
  Eigen::VectorXd variance(model.input.size());
  for (int i = 0; i < variance.size(); ++i) {
    const double noise = sensor_deviation * sensor_deviation;
    // A difference has the noise of two frames.
    const double of_turn = i < statics ? noise + placement * placement : 2 * noise;
    variance[i] =
        turns[model.input.modelled[i % statics]]
            ? of_turn / (model.input_scaling.deviation[i] * model.input_scaling.deviation[i])
            : 0;
  }
  return variance;
}

void set_states(Model& model, const StateTable& table,
                const std::vector<StateStatistics>& statistics, const std::vector<double>& stay,
                const Eigen::VectorXd& target, double regularisation, double placement) {
  const int inputs = model.input.size();
  const Eigen::VectorXd sensor = sensor_variance(model, placement);
  for (std::size_t i = 0; i < model.labels.size(); ++i) {
    Label& label = model.labels[i];
    label.states.resize(table.states[i]);  // what was learnt of trajectories stays
    for (int k = 0; k < table.states[i]; ++k) {
      const int index = table.first_state[i] + k;
      const StateStatistics& counted = statistics[index];
      State& state = label.states[k];
      state.mean = counted.mean();
      state.covariance = regularised(counted.covariance(), counted.count, target, regularisation);
      state.covariance.diagonal().head(inputs) += sensor;
      state.stay = stay[index];
      state.weight = counted.count;
      state.duration = 1 / (1 - stay[index]) / model.frame_rate;
      const int styles = static_cast<int>(counted.style_counts.size());
      if (styles == 0) continue;
      state.style_means.resize(state.mean.size(), styles);
      for (int style = 0; style < styles; ++style)
        // A style without frames in this state gets the mean of all styles.
        state.style_means.col(style) =
            counted.style_counts[style] > 1e-6
                ? Eigen::VectorXd(counted.style_sums.col(style) / counted.style_counts[style])
                : state.mean;
      state.style_covariance = regularised(counted.within_style_covariance(inputs), counted.count,
                                           target.head(inputs), regularisation);
      state.style_covariance.diagonal() += sensor;
    }
  }
}

Learnt learn(const LearningTask& task, const LearningOptions& options) {
  if (options.states < 1) throw Error("expected at least one state per label");
  Learnt learnt;
  learnt.observed = observe(task.sequences, lags_at(options.history, task.frame_rate),
                            task.body ? options.clip : InputLayout().clip);
  learnt.table = StateTable(std::vector<int>(task.labels.size(), options.states));

  Model& model = learnt.model;
  model.frame_rate = task.frame_rate;
  model.inputs = task.inputs;
  model.outputs = task.outputs;
  model.styles = task.styles;
  model.input = learnt.observed.input;
  model.output = learnt.observed.output;
  model.input_scaling = learnt.observed.input_scaling;
  model.output_scaling = learnt.observed.output_scaling;
  model.output_mean = learnt.observed.output_mean;
  model.input_mean = learnt.observed.input_mean;
  model.body = task.body;
  if (model.body) {
    model.body->hips_frame = options.hips_frame;
    model.play.trust = options.trust;
    model.play.easing = options.easing;
  }
  for (const LabelPlan& plan : task.labels)
    model.labels.push_back({plan.name, plan.successors, {}, 0, 0, 0, 0, {}});
  set_durations(model, learnt.observed);

  learnt.states = train_states(learnt.observed.sequences, learnt.table,
                               static_cast<int>(task.styles.size()), options.hmm);
  set_states(model, learnt.table, learnt.states.statistics, learnt.states.stay,
             learnt.states.target, options.hmm.regularisation, options.placement);
  set_trajectories(model, task.sequences, learnt.observed, learnt.table, learnt.states.alignments);
  set_phases(model, task.sequences, learnt.observed, learnt.table, learnt.states.alignments,
             options.hmm.regularisation);
  model.training.regularisation = options.hmm.regularisation;
  model.training.target = learnt.states.target;
  model.training.placement = options.placement;
  model.training.log_likelihood = learnt.states.log_likelihood;
  model.training.penalised_log_likelihood = learnt.states.penalised_log_likelihood;
  for (const ObservedSequence& sequence : learnt.observed.sequences) {
    model.training.clips.push_back(sequence.name);
    const std::string& subject = task.sequences[sequence.source].subject;
    std::vector<std::string>& subjects = model.training.subjects;
    if (!subject.empty() && std::ranges::find(subjects, subject) == subjects.end())
      subjects.push_back(subject);
  }
  return learnt;
}

}  // namespace gait
