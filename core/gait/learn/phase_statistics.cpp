#include "gait/learn/phase_statistics.h"

#include <cmath>
#include <optional>

#include "gait/model/label_cycle.h"

namespace gait {

namespace {

// The phase of a sequence at any time in frames, while its labels last: time passes evenly between
// the onsets of labels.
class LabelledPhase {
 public:
  LabelledPhase(const std::vector<Segment>& segments, const std::vector<LabelCycle>& cycles)
      : segments_(segments), cycles_(cycles) {}

  std::optional<double> at(double frame) {
    while (next_ < segments_.size() && onset(next_) <= frame) ++next_;
    while (next_ > 0 && onset(next_ - 1) > frame) --next_;
    if (next_ == 0) return std::nullopt;
    const Segment& segment = segments_[next_ - 1];
    const double begin = onset(next_ - 1);
    const double end = next_ < segments_.size() ? onset(next_) : segment.end;
    if (frame >= end) return std::nullopt;
    const LabelCycle& cycle = cycles_[segment.label];
    return (cycle.index + (frame - begin) / (end - begin)) / cycle.labels;
  }

 private:
  double onset(std::size_t i) const { return segments_[i].begin + segments_[i].offset; }

  const std::vector<Segment>& segments_;
  const std::vector<LabelCycle>& cycles_;
  std::size_t next_ = 0;  // the first segment that begins later
};

// Sums over the frames of a state; phases are counted from the middle of what the state spans.
struct PhaseSums {
  double middle = 0, count = 0, phase = 0;
  Eigen::VectorXd x, products;
};

}  // namespace

void set_phases(Model& model, const std::vector<Sequence>& sequences,
                const ObservationSet& observed, const StateTable& table,
                const std::vector<Alignment>& alignments, double regularisation) {
  const std::vector<LabelCycle> cycles = label_cycles(model);
  if (cycles.empty() || cycles.front().labels != static_cast<int>(model.labels.size())) return;
  const double age = model.input.mean_age();
  const int inputs = model.input.size();
  std::vector<PhaseSums> states(table.total);
  for (std::size_t label = 0; label < model.labels.size(); ++label)
    for (int k = 0; k < table.states[label]; ++k) {
      PhaseSums& state = states[table.first_state[label] + k];
      const double share = (k + 0.5) / table.states[label];
      state.middle = (cycles[label].index + share) / cycles[label].labels -
                     cycles[label].frequency * age / model.frame_rate;
      state.x = state.products = Eigen::VectorXd::Zero(inputs);
    }
  for (std::size_t i = 0; i < observed.sequences.size(); ++i) {
    const ObservedSequence& sequence = observed.sequences[i];
    LabelledPhase labelled(sequences[sequence.source].segments, cycles);
    for (const Occupancy& at : alignments[i].occupancies) {
      const std::optional<double> phase = labelled.at(at.frame - age);
      if (!phase) continue;
      PhaseSums& state = states[at.state];
      const double from_middle = *phase - state.middle - std::round(*phase - state.middle);
      state.count += at.share;
      state.phase += at.share * from_middle;
      state.x += at.share * sequence.x.col(at.frame);
      state.products += at.share * from_middle * sequence.x.col(at.frame);
    }
  }
  for (const PhaseSums& state : states)
    if (state.count < 1) return;
  for (std::size_t label = 0; label < model.labels.size(); ++label)
    for (int k = 0; k < table.states[label]; ++k) {
      const PhaseSums& sums = states[table.first_state[label] + k];
      State& state = model.labels[label].states[k];
      const double phase = sums.middle + sums.phase / sums.count;
      state.phase = phase - std::floor(phase);
      state.phase_covariance =
          (sums.products - sums.phase / sums.count * sums.x) / (sums.count + regularisation);
    }
}

}  // namespace gait
