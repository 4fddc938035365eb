#include "gait/learn/trajectory_statistics.h"

#include <algorithm>

namespace gait {

namespace {

// Variances are drawn towards the mean of all states' as if that had been seen in so many frames.
constexpr double prior_frames = 10;
constexpr double least_variance = 1e-12;  // of values that hardly move within states, unit squared

struct Counted {
  Eigen::VectorXd counts;           // frames by share, per column of means
  Eigen::MatrixXd sums;             // entries by columns
  double count = 0;                 // with those of no style
  Eigen::VectorXd sum, deviations;  // of all frames; sum of squares about the styles' means
};

}  // namespace

Eigen::MatrixXd trajectory_of(const Sequence& sequence, const InputLayout& input,
                              const OutputLayout& output) {
  const Eigen::MatrixXd inputs = with_differences(sequence.inputs, input.modelled);
  const Eigen::MatrixXd outputs = with_differences(sequence.outputs, output.modelled);
  const Eigen::Index of_input = inputs.rows() / 3, of_output = outputs.rows() / 3;
  Eigen::MatrixXd all(inputs.rows() + outputs.rows(), inputs.cols());
  for (Eigen::Index part = 0; part < 3; ++part)
    all.middleRows(part * (of_input + of_output), of_input + of_output)
        << inputs.middleRows(part * of_input, of_input),
        outputs.middleRows(part * of_output, of_output);
  return all;
}

void set_trajectories(Model& model, const std::vector<Sequence>& sequences,
                      const ObservationSet& observed, const StateTable& table,
                      const std::vector<Alignment>& alignments) {
  const Eigen::Index entries = 3 * model.trajectory_values();
  const bool styled = !model.styles.empty();
  const auto columns = styled ? static_cast<Eigen::Index>(model.styles.size()) : 1;
  const auto column_of = [&](const ObservedSequence& sequence) {
    return styled ? sequence.style : 0;
  };
  std::vector<Counted> states(
      table.total, {Eigen::VectorXd::Zero(columns), Eigen::MatrixXd::Zero(entries, columns), 0,
                    Eigen::VectorXd::Zero(entries), Eigen::VectorXd::Zero(entries)});
  std::vector<Eigen::MatrixXd> values;
  for (const ObservedSequence& sequence : observed.sequences)
    values.push_back(trajectory_of(sequences[sequence.source], observed.input, observed.output));

  for (std::size_t i = 0; i < values.size(); ++i)
    for (const Occupancy& at : alignments[i].occupancies) {
      Counted& state = states[at.state];
      const int column = column_of(observed.sequences[i]);
      state.count += at.share;
      state.sum += at.share * values[i].col(at.frame);
      if (column < 0) continue;
      state.counts[column] += at.share;
      state.sums.col(column) += at.share * values[i].col(at.frame);
    }
  for (Counted& state : states)
    for (Eigen::Index column = 0; column < columns; ++column)
      if (state.counts[column] > 1e-6)
        state.sums.col(column) /= state.counts[column];
      else
        state.sums.col(column) = state.sum / state.count;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (const Occupancy& at : alignments[i].occupancies) {
      const int column = column_of(observed.sequences[i]);
      if (column < 0) continue;
      Counted& state = states[at.state];
      state.deviations += at.share * (values[i].col(at.frame) - state.sums.col(column)).cwiseAbs2();
    }

  Eigen::VectorXd pooled = Eigen::VectorXd::Zero(entries);
  double count = 0;
  for (const Counted& state : states) pooled += state.deviations, count += state.counts.sum();
  pooled /= std::max(count, 1.0);
  for (std::size_t label = 0; label < model.labels.size(); ++label)
    for (int k = 0; k < table.states[label]; ++k) {
      const Counted& counted = states[table.first_state[label] + k];
      State& state = model.labels[label].states[k];
      state.trajectory_means = counted.sums;
      state.trajectory_variances =
          ((counted.deviations + prior_frames * pooled) / (counted.counts.sum() + prior_frames))
              .cwiseMax(least_variance);
    }
}

}  // namespace gait
