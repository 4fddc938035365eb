#include "gait/learn/alignment.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gait {

namespace {

constexpr double impossible = -std::numeric_limits<double>::infinity();
constexpr double negligible_share = 1e-8;

double log_sum(double a, double b) {
  if (a < b) std::swap(a, b);
  return b == impossible ? a : a + std::log1p(std::exp(b - a));
}

// The chain of states of a sequence, and the range of frames that each may take.
struct Row {
  std::vector<int> state;               // over all labels
  std::vector<int> begin, end;          // frames [begin, end) allowed
  int first_frame = 0, last_frame = 0;  // frames [first, last)

  Row(const ObservedSequence& sequence, const StateTable& table, int slack) {
    first_frame = sequence.segments.front().begin;
    last_frame = sequence.segments.back().end;
    for (const Segment& segment : sequence.segments)
      for (int k = 0; k < table.states[segment.label]; ++k) {
        state.push_back(table.first_state[segment.label] + k);
        begin.push_back(std::max(first_frame, segment.begin - slack));
        end.push_back(std::min(last_frame, segment.end + slack));
      }
  }
  int size() const { return static_cast<int>(state.size()); }
  int frames() const { return last_frame - first_frame; }
  bool allows(int place, int frame) const { return frame >= begin[place] && frame < end[place]; }
};

// Log-likelihoods of every place's allowed frames; `impossible` elsewhere. Places by frames.
Eigen::MatrixXd emissions_of(const ObservedSequence& sequence, const Row& row,
                             const EmissionModel& model) {
  Eigen::MatrixXd log_emission = Eigen::MatrixXd::Constant(row.size(), row.frames(), impossible);
  for (int place = 0; place < row.size(); ++place) {
    const int begin = row.begin[place], count = row.end[place] - begin;
    if (count > 0)
      log_emission.row(place).segment(begin - row.first_frame, count) =
          model.of_state[row.state[place]]
              .log_likelihoods(sequence.x.middleCols(begin, count))
              .transpose();
  }
  return log_emission;
}

Alignment hard_alignment(const Row& row, const Eigen::MatrixXd& log_emission,
                         const EmissionModel& model, int states) {
  const int frames = row.frames(), places = row.size();
  Eigen::MatrixXd best = Eigen::MatrixXd::Constant(places, frames, impossible);
  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> moved(places, frames);
  moved.setConstant(false);
  best(0, 0) = log_emission(0, 0);
  for (int t = 1; t < frames; ++t)
    for (int p = 0; p < places; ++p) {
      if (log_emission(p, t) == impossible) continue;
      const double stayed = best(p, t - 1) + std::log(model.stay[row.state[p]]);
      const double came =
          p == 0 ? impossible : best(p - 1, t - 1) + std::log1p(-model.stay[row.state[p - 1]]);
      moved(p, t) = came > stayed;
      best(p, t) = std::max(stayed, came) + log_emission(p, t);
    }
  Alignment alignment;
  alignment.log_likelihood = best(places - 1, frames - 1);
  if (alignment.log_likelihood == impossible) return alignment;
  alignment.stays.assign(states, 0.0);
  alignment.leaves.assign(states, 0.0);
  for (int t = frames - 1, p = places - 1; t >= 0; --t) {
    alignment.occupancies.push_back({row.first_frame + t, row.state[p], 1.0});
    if (t == 0) break;
    if (moved(p, t)) {
      --p;
      alignment.leaves[row.state[p]] += 1;
    } else {
      alignment.stays[row.state[p]] += 1;
    }
  }
  std::reverse(alignment.occupancies.begin(), alignment.occupancies.end());
  return alignment;
}

Alignment soft_alignment(const Row& row, const Eigen::MatrixXd& log_emission,
                         const EmissionModel& model, int states) {
  const int frames = row.frames(), places = row.size();
  std::vector<double> log_stay(places), log_leave(places);
  for (int p = 0; p < places; ++p) {
    log_stay[p] = std::log(model.stay[row.state[p]]);
    log_leave[p] = std::log1p(-model.stay[row.state[p]]);
  }
  Eigen::MatrixXd forward = Eigen::MatrixXd::Constant(places, frames, impossible);
  Eigen::MatrixXd backward = forward;
  forward(0, 0) = log_emission(0, 0);
  for (int t = 1; t < frames; ++t)
    for (int p = 0; p < places; ++p) {
      if (log_emission(p, t) == impossible) continue;
      const double stayed = forward(p, t - 1) + log_stay[p];
      const double came = p == 0 ? impossible : forward(p - 1, t - 1) + log_leave[p - 1];
      forward(p, t) = log_sum(stayed, came) + log_emission(p, t);
    }
  Alignment alignment;
  alignment.log_likelihood = forward(places - 1, frames - 1);
  if (!(alignment.log_likelihood > impossible)) {
    alignment.log_likelihood = impossible;
    return alignment;
  }
  backward(places - 1, frames - 1) = 0;
  for (int t = frames - 2; t >= 0; --t)
    for (int p = 0; p < places; ++p) {
      if (log_emission(p, t) == impossible) continue;
      const double stay = backward(p, t + 1) + log_stay[p] + log_emission(p, t + 1);
      const double leave = p + 1 == places
                               ? impossible
                               : backward(p + 1, t + 1) + log_leave[p] + log_emission(p + 1, t + 1);
      backward(p, t) = log_sum(stay, leave);
    }
  alignment.stays.assign(states, 0.0);
  alignment.leaves.assign(states, 0.0);
  for (int t = 0; t < frames; ++t)
    for (int p = 0; p < places; ++p) {
      const double share = std::exp(forward(p, t) + backward(p, t) - alignment.log_likelihood);
      if (!(share > negligible_share)) continue;
      alignment.occupancies.push_back({row.first_frame + t, row.state[p], share});
      if (t + 1 == frames) continue;
      const double before = forward(p, t) - alignment.log_likelihood;
      alignment.stays[row.state[p]] +=
          std::exp(before + log_stay[p] + log_emission(p, t + 1) + backward(p, t + 1));
      if (p + 1 < places)
        alignment.leaves[row.state[p]] +=
            std::exp(before + log_leave[p] + log_emission(p + 1, t + 1) + backward(p + 1, t + 1));
    }
  return alignment;
}

// Log-likelihood of x along a given path.
double log_likelihood_of(const Alignment& path, const ObservedSequence& sequence,
                         const EmissionModel& model) {
  double sum = 0;
  for (const Occupancy& at : path.occupancies)
    sum += model.of_state[at.state].log_likelihoods(sequence.x.col(at.frame))[0];
  for (std::size_t state = 0; state < model.stay.size(); ++state)
    sum += path.stays[state] * std::log(model.stay[state]) +
           path.leaves[state] * std::log1p(-model.stay[state]);
  return sum;
}

}  // namespace

StateTable::StateTable(const std::vector<int>& states_per_label) : states(states_per_label) {
  for (const int count : states_per_label) {
    first_state.push_back(total);
    total += count;
  }
}

Alignment align_equally(const ObservedSequence& sequence, const StateTable& table) {
  Alignment alignment;
  alignment.stays.assign(table.total, 0.0);
  alignment.leaves.assign(table.total, 0.0);
  for (const Segment& segment : sequence.segments) {
    const int length = segment.end - segment.begin, states = table.states[segment.label];
    int before = -1;
    for (int frame = segment.begin; frame < segment.end; ++frame) {
      const int state =
          table.first_state[segment.label] + (frame - segment.begin) * states / length;
      alignment.occupancies.push_back({frame, state, 1.0});
      if (before >= 0) (before == state ? alignment.stays : alignment.leaves)[before] += 1;
      before = state;
    }
    if (before >= 0) alignment.leaves[before] += 1;
  }
  return alignment;
}

Alignment align(const ObservedSequence& sequence, const StateTable& table,
                const EmissionModel& emissions, int slack, bool hard) {
  const Row row(sequence, table, slack);
  const Eigen::MatrixXd log_emission = emissions_of(sequence, row, emissions);
  Alignment alignment = hard ? hard_alignment(row, log_emission, emissions, table.total)
                             : soft_alignment(row, log_emission, emissions, table.total);
  if (!(alignment.log_likelihood > impossible)) {
    const Alignment equal = align_equally(sequence, table);
    alignment.occupancies = equal.occupancies;
    alignment.stays = equal.stays;
    alignment.leaves = equal.leaves;
    alignment.log_likelihood = log_likelihood_of(equal, sequence, emissions);
  }
  return alignment;
}

}  // namespace gait
