#include "gait/teach/takes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "gait/error.h"
#include "gait/judge/played_sequence.h"

namespace gait {

namespace {

constexpr int shortest_take = 5;  // frames
constexpr int most_folds = 5;
// Seconds of the trajectory's past. Differences of what a hand draws are surer than their statics:
// over the whole past, an output lags so far behind that its error grows by a twentieth.
constexpr double followed_past = 20.0 / 30;
constexpr double usual_share = 0.98;  // of held-out takes that count as like what was taught

std::string name_of(const Take& take, std::size_t number) {
  return "take " + std::to_string(number) + " ('" + take.label + "')";
}

std::vector<Stream> plain_streams(const std::string& name, Eigen::Index count) {
  std::vector<Stream> streams;
  for (Eigen::Index i = 0; i < count; ++i)
    streams.push_back({name + " " + std::to_string(i), 1, StreamKind::plain});
  return streams;
}

void check(const std::vector<Take>& takes) {
  if (takes.empty()) throw Error("expected at least one take; found none");
  for (std::size_t i = 0; i < takes.size(); ++i) {
    const Take& take = takes[i];
    const auto differs = [&](const char* what, Eigen::Index found, Eigen::Index wanted) {
      throw Error(name_of(take, i) + ": expected " + std::to_string(wanted) + " " + what +
                  ", as in the first take; found " + std::to_string(found));
    };
    if (take.inputs.rows() != takes.front().inputs.rows())
      differs("input values", take.inputs.rows(), takes.front().inputs.rows());
    if (take.outputs.rows() != takes.front().outputs.rows())
      differs("output values", take.outputs.rows(), takes.front().outputs.rows());
    if (take.outputs.rows() > 0 && take.outputs.cols() != take.inputs.cols())
      throw Error(name_of(take, i) + ": expected as many frames of output as of input, " +
                  std::to_string(take.inputs.cols()) + "; found " +
                  std::to_string(take.outputs.cols()));
    if (take.inputs.cols() < shortest_take)
      throw Error(name_of(take, i) + ": expected at least " + std::to_string(shortest_take) +
                  " frames; found " + std::to_string(take.inputs.cols()));
    if (!take.inputs.allFinite() || !take.outputs.allFinite())
      throw Error(name_of(take, i) + ": expected finite values; found others");
  }
}

// A take begins at rest where it begins: its first frame is held for as long as differences reach
// back, and its last one frame longer, so that none of it is left out.
Eigen::MatrixXd padded(const Eigen::MatrixXd& values, int before) {
  Eigen::MatrixXd result(values.rows(), before + values.cols() + 1);
  result << values.col(0).replicate(1, before), values, values.rightCols(1);
  return result;
}

LearningTask task_of(const std::vector<Take>& takes, double frame_rate, int history) {
  LearningTask task;
  task.frame_rate = frame_rate;
  const bool outputs = takes.front().outputs.rows() > 0;
  task.inputs = plain_streams("in", takes.front().inputs.rows());
  task.outputs = outputs ? plain_streams("out", takes.front().outputs.rows()) : task.inputs;
  for (std::size_t i = 0; i < takes.size(); ++i) {
    const Take& take = takes[i];
    auto at = std::ranges::find(task.labels, take.label, &LabelPlan::name);
    if (at == task.labels.end()) at = task.labels.insert(at, {take.label, {}});
    Sequence sequence;
    sequence.name = name_of(take, i);
    sequence.inputs = padded(take.inputs, history);
    sequence.outputs = outputs ? padded(take.outputs, history) : sequence.inputs;
    sequence.segments = {{history, history + static_cast<int>(take.inputs.cols()),
                          static_cast<int>(at - task.labels.begin())}};
    task.sequences.push_back(std::move(sequence));
  }
  for (LabelPlan& label : task.labels)
    for (std::size_t next = 0; next < task.labels.size(); ++next)
      label.successors.push_back(static_cast<int>(next));
  return task;
}

// What playing takes that a model has not seen showed.
struct Played {
  int right = 0, takes = 0;
  double error = 0;
  std::vector<double> distances;  // mean over each take
};

void play(const std::shared_ptr<const Model>& model, const LearningTask& task,
          const Sequence& sequence, Played& so_far) {
  const PlayedSequence played = play_sequence(model, {}, sequence);
  std::vector<int> votes(task.labels.size(), 0);
  double error = 0, distance = 0;
  for (int frame = played.begin; frame < played.end; ++frame) {
    const Decision& decision = played.decisions[frame];
    ++votes[decision.label];
    distance += decision.distance;
    error += stream_errors(*model, played.outputs.col(frame), sequence.outputs.col(frame)).mean();
  }
  const double frames = std::max(1, played.end - played.begin);
  so_far.right += std::ranges::max_element(votes) - votes.begin() == sequence.segments[0].label;
  so_far.error += error / frames;
  so_far.distances.push_back(distance / frames);
  ++so_far.takes;
}

// Leaves takes out fold by fold, so that of each label some stay where it has two or more; learns
// the rest as the whole was learnt.
Played play_held_out(const LearningTask& task, const LearningOptions& options) {
  std::map<int, int> of_label, dealt;
  for (const Sequence& sequence : task.sequences) ++of_label[sequence.segments[0].label];
  Played played;
  const int folds = std::min<int>(most_folds, static_cast<int>(task.sequences.size()));
  std::vector<int> fold_of(task.sequences.size());
  for (std::size_t i = 0; i < fold_of.size(); ++i)
    fold_of[i] = dealt[task.sequences[i].segments[0].label]++ % folds;
  for (int fold = 0; fold < folds; ++fold) {
    if (options.hmm.cancel.requested()) throw Error("cancelled");
    LearningTask rest = task;
    rest.sequences.clear();
    std::map<int, int> left;
    for (std::size_t i = 0; i < fold_of.size(); ++i)
      if (fold_of[i] != fold) {
        rest.sequences.push_back(task.sequences[i]);
        ++left[task.sequences[i].segments[0].label];
      }
    if (left.size() < of_label.size()) continue;  // a label with a single take cannot be left out
    const auto model = std::make_shared<Model>(learn(rest, options).model);
    model->play.past = followed_past;
    for (std::size_t i = 0; i < fold_of.size(); ++i)
      if (fold_of[i] == fold) play(model, task, task.sequences[i], played);
  }
  return played;
}

// Of one output value, over all frames.
double output_deviation(const std::vector<Take>& takes) {
  Eigen::Index rows = takes.front().outputs.rows();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows), squares = sum;
  double count = 0;
  for (const Take& take : takes) {
    sum += take.outputs.rowwise().sum();
    squares += take.outputs.rowwise().squaredNorm();
    count += static_cast<double>(take.outputs.cols());
  }
  const Eigen::VectorXd variance = squares / count - (sum / count).cwiseAbs2();
  return variance.cwiseMax(0).cwiseSqrt().mean();
}

}  // namespace

TakesLearnt learn_takes(const std::vector<Take>& takes, const TakeOptions& options) {
  check(takes);
  SelectionOptions selection;
  LearningOptions& learning = selection.learning;
  learning.hmm.threads = options.threads;
  learning.hmm.cancel = options.cancel;
  if (options.progress)
    learning.hmm.progress = [&](double share, const std::string& what) {
      options.progress(0.7 * share, what);
    };
  Eigen::Index shortest = takes.front().inputs.cols();
  for (const Take& take : takes) shortest = std::min(shortest, take.inputs.cols());
  learning.states = std::clamp(static_cast<int>(shortest / 2), 2, learning.states);
  const int history = static_cast<int>(std::lround(learning.history.back() * options.frame_rate));
  const LearningTask task = task_of(takes, options.frame_rate, history);

  TakesLearnt learnt;
  learnt.model = select_model(task, selection).model;
  learnt.model.play.past = followed_past;
  learning.hmm.progress = nullptr;
  learning.hmm.regularisation = learnt.model.training.regularisation;
  learning.hmm.soft_iterations = static_cast<int>(learnt.model.training.log_likelihood.size());
  if (options.progress) options.progress(0.7, "playing takes that were left out");
  Played played = play_held_out(task, learning);
  if (played.takes > 0) {
    learnt.judged.takes = played.takes;
    learnt.judged.accuracy = static_cast<double>(played.right) / played.takes;
    if (takes.front().outputs.rows() > 0)
      learnt.judged.error = played.error / played.takes / std::max(1e-12, output_deviation(takes));
    std::ranges::sort(played.distances);
    learnt.model.play.usual_distance =
        played.distances[static_cast<std::size_t>(usual_share * (played.takes - 1) + 0.5)];
  }
  if (options.progress) options.progress(1, "done");
  return learnt;
}

}  // namespace gait
