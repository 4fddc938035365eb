#include "gait/teach/enrolment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gait/error.h"
#include "gait/judge/folds.h"
#include "gait/judge/played_sequence.h"
#include "gait/learn/state_statistics.h"
#include "gait/learn/trainer.h"
#include "gait/learn/trajectory_statistics.h"
#include "gait/motion/contacts.h"
#include "gait/motion/resample.h"

namespace gait {

namespace {

constexpr int fewest_cycles = 2;
constexpr double half_share_seconds = 5;    // of walking: then the stranger is half of the model
constexpr double straight_limit = 0.17453;  // radians by which the heading may change (T10 §3)

// One cycle of the stranger: scaled observations, and where it was cut from.
struct StrangerCycle {
  ObservedSequence observed;
  Eigen::MatrixXd trajectory;  // unscaled, as State::trajectory_means, frame after frame
  int source = 0;              // index into the stranger's sequences
  int begin = 0, end = 0;      // its frames there
};

struct Stranger {
  std::vector<Sequence> sequences;
  std::vector<StrangerCycle> cycles;
  std::vector<std::string> left_out;
};

void check_enrollable(const Model& model) {
  if (!model.body) throw Error("model " + model.name + ": expected a model of a body to enrol in");
  if (model.labels.size() != 2)
    throw Error("model " + model.name + ": expected the steps right and left to enrol in");
  if (model.training.target.size() == 0)
    throw Error(
        "model " + model.name +
        ": expected what covariances were shrunk towards (training.target), which enrolment "
        "needs; the model was made before models kept it: train it again");
}

// All of a sequence as the model observes it, then cut into straight cycles of two steps.
// `heading`: radians, per frame.
void add_cycles(const Model& model, const Sequence& sequence, const std::vector<double>& heading,
                int source, Stranger& stranger) {
  const auto frames = sequence.inputs.cols();
  Eigen::MatrixXd x(model.input.size(), frames);
  InputObserver<double> observer(model.input, model.input_scaling);
  for (Eigen::Index frame = 0; frame < frames; ++frame) {
    observer.advance(
        {sequence.inputs.col(frame).data(), static_cast<std::size_t>(model.input.values)});
    x.col(frame) = observer.scaled();
  }
  const Eigen::MatrixXd y =
      scaled_by(model.output_scaling, with_differences(sequence.outputs, model.output.modelled));
  const Eigen::MatrixXd trajectory = trajectory_of(sequence, model.input, model.output);

  const int history = model.input.lags.empty() ? 0 : model.input.lags.back();
  std::vector<Segment> segments;
  for (const Segment& segment : sequence.segments)
    if (segment.begin >= history && segment.end < frames) segments.push_back(segment);
  const auto follows = [&](std::size_t i) {
    return i < segments.size() && segments[i - 1].end == segments[i].begin;
  };
  for (std::size_t i = 0; i + 1 < segments.size();) {
    // Two steps; three where the last has no other beside it.
    const std::size_t steps = follows(i + 2) && !follows(i + 3) ? 3 : 2;
    const int begin = segments[i].begin, end = segments[i + steps - 1].end;
    if (!follows(i + 1) || !(std::abs(heading[end] - heading[begin]) < straight_limit)) {
      ++i;
      continue;
    }
    StrangerCycle cycle{{}, trajectory.middleCols(begin, end - begin), source, begin, end};
    cycle.observed.x = x.middleCols(begin, end - begin);
    cycle.observed.y = y.middleCols(begin, end - begin);
    for (std::size_t step = i; step < i + steps; ++step)
      cycle.observed.segments.push_back(
          {segments[step].begin - begin, segments[step].end - begin, segments[step].label});
    stranger.cycles.push_back(std::move(cycle));
    i += steps;
  }
}

Stranger stranger_of(const Model& model, const std::vector<Walk>& walks,
                     const EnrolmentOptions& options) {
  Stranger stranger;
  double frames_left = options.seconds * model.frame_rate;
  for (const Walk& walk : walks) {
    const Clip clip = resampled(walk.clip, model.frame_rate);
    const std::vector<int> matched = match_joints(*model.body, clip.skeleton, clip.name);
    WalkTrack track = follow_walk(clip, find_roles(clip, options.roles));
    if (!walk.contacts.empty())
      track.contacts = contacts_at(walk.contacts, model.frame_rate / walk.clip.frame_rate);
    const BodyPoses poses = body_poses(clip, *model.body, matched, track.cycle_seconds);
    Sequence sequence = walk_sequence(*model.body, poses, track.contacts, clip.name);
    if (!sequence.inputs.allFinite() || !sequence.outputs.allFinite())
      throw Error(clip.name + ": expected finite rotations; found others");
    const std::size_t before = stranger.cycles.size();
    add_cycles(model, sequence, track.heading, static_cast<int>(stranger.sequences.size()),
               stranger);
    if (stranger.cycles.size() == before)
      stranger.left_out.push_back(clip.name + ": expected straight cycles, found none");
    stranger.sequences.push_back(std::move(sequence));
    for (std::size_t i = before; i < stranger.cycles.size(); ++i) {
      frames_left -= stranger.cycles[i].end - stranger.cycles[i].begin;
      if (frames_left < 0 && i + 1 < stranger.cycles.size()) stranger.cycles.resize(i + 1);
    }
    if (frames_left < 0) break;
  }
  if (std::ssize(stranger.cycles) < fewest_cycles)
    throw Error("expected at least " + std::to_string(fewest_cycles) +
                " whole cycles of straight walking to enrol, found " +
                std::to_string(stranger.cycles.size()));
  return stranger;
}

// What some of the stranger's cycles say of one state's trajectory.
struct TrajectoryCount {
  double count = 0;
  Eigen::VectorXd sum, squares;
};

class Merge {
 public:
  // `chosen`: which of the cycles to merge.
  Merge(const Model& model, const Stranger& stranger, const std::vector<int>& chosen,
        std::optional<double> weight)
      : model_(model), table_(states_of(model)) {
    std::vector<ObservedSequence> cycles;
    std::vector<Alignment> alignments;
    std::vector<int> all;
    for (const int i : chosen) {
      all.push_back(static_cast<int>(cycles.size()));
      cycles.push_back(stranger.cycles[i].observed);
      alignments.push_back(align_equally(cycles.back(), table_));
      frames_ += static_cast<double>(cycles.back().x.cols());
    }
    statistics_ = gather(cycles, alignments, all, table_.total, 0, 1);
    trajectories_.assign(table_.total, {0, Eigen::VectorXd::Zero(3 * model.trajectory_values()),
                                        Eigen::VectorXd::Zero(3 * model.trajectory_values())});
    for (std::size_t i = 0; i < chosen.size(); ++i)
      for (const Occupancy& at : alignments[i].occupancies) {
        TrajectoryCount& of = trajectories_[at.state];
        const auto values = stranger.cycles[chosen[i]].trajectory.col(at.frame);
        of.count += 1, of.sum += values, of.squares += values.cwiseAbs2();
      }
    lengths_.assign(model.labels.size(), {});
    for (const ObservedSequence& cycle : cycles)
      for (const Segment& segment : cycle.segments)
        lengths_[segment.label].push_back((segment.end - segment.begin) / model.frame_rate);
    double taught = 0;
    for (const Label& label : model.labels)
      for (const State& state : label.states) taught += state.weight;
    const double half = half_share_seconds * model.frame_rate;
    // A share s of n / (n + half) is a weight of s / (1 - s) * taught / n.
    weight_ = weight.value_or(taught / half);
    share_ = weight_ * frames_ / (weight_ * frames_ + taught);
  }

  Model merged() const {
    Model merged = model_;
    for (std::size_t label = 0; label < merged.labels.size(); ++label) {
      for (std::size_t k = 0; k < merged.labels[label].states.size(); ++k)
        merge(merged.labels[label].states[k], table_.first_state[label] + static_cast<int>(k));
      merge_durations(merged.labels[label], lengths_[label]);
    }
    return merged;
  }

  double share() const { return share_; }

 private:
  static StateTable states_of(const Model& model) {
    std::vector<int> states;
    for (const Label& label : model.labels) states.push_back(static_cast<int>(label.states.size()));
    return StateTable(states);
  }

  void merge(State& state, int index) const {
    const StateStatistics& counted = statistics_[index];
    if (!(counted.count > 0)) return;
    const double f = weight_ * counted.count / (weight_ * counted.count + state.weight);
    const double kappa = model_.training.regularisation, frames = state.weight + counted.count;
    const Eigen::VectorXd& target = model_.training.target;
    const Eigen::VectorXd sensor = sensor_variance(model_, model_.training.placement);
    const int inputs = model_.input.size();
    const Eigen::VectorXd moves = counted.mean() - state.mean;
    const auto pooled = [&](Eigen::MatrixXd covariance, const Eigen::MatrixXd& of_stranger,
                            const Eigen::VectorXd& between) {
      const Eigen::Index size = covariance.rows();
      // As it was before it was widened and shrunk.
      covariance.diagonal().head(inputs) -= sensor;
      covariance *= (state.weight + kappa) / state.weight;
      covariance.diagonal() -= kappa / state.weight * target.head(size);
      covariance =
          (1 - f) * covariance + f * of_stranger + f * (1 - f) * between * between.transpose();
      covariance = regularised(covariance, frames, target.head(size), kappa);
      covariance.diagonal().head(inputs) += sensor;
      return covariance;
    };
    const Eigen::MatrixXd own = counted.covariance();
    state.covariance = pooled(state.covariance, own, moves);
    state.mean += f * moves;
    if (state.style_means.size() > 0) {
      // Within styles: which one the stranger's walk is in, it does not say.
      state.style_covariance = pooled(state.style_covariance, own.topLeftCorner(inputs, inputs),
                                      Eigen::VectorXd::Zero(inputs));
      state.style_means.colwise() += f * moves;
    }
    merge_trajectory(state, trajectories_[index], f);
    state.weight = frames;
  }

  static void merge_trajectory(State& state, const TrajectoryCount& counted, double f) {
    if (state.trajectory_means.size() == 0) return;
    const Eigen::VectorXd mean = counted.sum / counted.count;
    const Eigen::VectorXd variance =
        (counted.squares / counted.count - mean.cwiseAbs2()).cwiseMax(0);
    const Eigen::VectorXd moves = mean - state.trajectory_means.rowwise().mean();
    state.trajectory_means.colwise() += f * moves;
    state.trajectory_variances = (1 - f) * state.trajectory_variances + f * variance;
  }

  void merge_durations(Label& label, const std::vector<double>& lengths) const {
    if (lengths.empty()) return;
    const Eigen::Map<const Eigen::VectorXd> seen(lengths.data(), std::ssize(lengths));
    const double duration = (1 - share_) * label.duration + share_ * seen.mean();
    const double ratio = duration / label.duration;
    label.duration = duration;
    label.style_durations *= ratio;
    label.shortest = std::min(label.shortest, seen.minCoeff());
    label.longest = std::max(label.longest, seen.maxCoeff());
    for (State& state : label.states) {
      state.duration *= ratio;
      state.stay = std::clamp(1 - 1 / (state.duration * model_.frame_rate), 1e-3, 1 - 1e-3);
    }
  }

  const Model& model_;
  StateTable table_;
  std::vector<StateStatistics> statistics_;
  std::vector<TrajectoryCount> trajectories_;
  std::vector<std::vector<double>> lengths_;  // of steps, per label, seconds
  double frames_ = 0, weight_ = 0, share_ = 0;
};

// A model's mean error over the frames of cycles, and the distances there.
struct CycleFigures {
  double error = 0, frames = 0;
  std::vector<float> distances;
};

void add_figures(const Model& model, const Stranger& stranger, const StrangerCycle& cycle,
                 CycleFigures& figures) {
  const Sequence& sequence = stranger.sequences[cycle.source];
  const PlayedSequence played =
      play_sequence(PlayModel(std::make_shared<const Model>(model)), {}, sequence);
  for (int frame = cycle.begin; frame < cycle.end; ++frame) {
    figures.error +=
        stream_errors(model, played.outputs.col(frame), sequence.outputs.col(frame)).mean();
    figures.distances.push_back(played.decisions[frame].distance);
    figures.frames += 1;
  }
}

}  // namespace

Enrolled enrol(const Model& model, const std::vector<Walk>& walks,
               const EnrolmentOptions& options) {
  check_enrollable(model);
  if (!(options.seconds > 0)) throw Error("expected more than 0 seconds to enrol");
  if (options.weight && !(*options.weight > 0 && std::isfinite(*options.weight)))
    throw Error("expected a weight above 0");
  const Stranger stranger = stranger_of(model, walks, options);
  std::vector<int> all(stranger.cycles.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);

  CycleFigures before, after;
  for (const int left_out : all) {
    std::vector<int> rest = all;
    std::erase(rest, left_out);
    const StrangerCycle& cycle = stranger.cycles[left_out];
    add_figures(model, stranger, cycle, before);
    add_figures(Merge(model, stranger, rest, options.weight).merged(), stranger, cycle, after);
  }
  Enrolled enrolled;
  enrolled.cycles = static_cast<int>(all.size());
  enrolled.seconds = after.frames / model.frame_rate;
  enrolled.error_before = before.error / before.frames;
  enrolled.error_after = after.error / after.frames;
  enrolled.left_out = stranger.left_out;
  if (!(enrolled.error_after < enrolled.error_before)) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "expected cycles left out one by one to come closer; they went from %.2f to %.2f "
                  "degrees off: the model stays as it was",
                  enrolled.error_before * 180 / std::numbers::pi,
                  enrolled.error_after * 180 / std::numbers::pi);
    throw Error(text);
  }

  const Merge merge(model, stranger, all, options.weight);
  enrolled.model = merge.merged();
  Model& merged = enrolled.model;
  merged.play.usual_distance = std::max(1e-3, (1 - merge.share()) * model.play.usual_distance +
                                                  merge.share() * usual_distance(after.distances));
  for (const Walk& walk : walks) {
    merged.training.clips.push_back(walk.clip.name);
    if (!walk.subject.empty() &&
        std::ranges::find(merged.training.subjects, walk.subject) == merged.training.subjects.end())
      merged.training.subjects.push_back(walk.subject);
  }
  return enrolled;
}

}  // namespace gait
