#include "gait/judge/folds.h"

#include <algorithm>
#include <numeric>

#include "gait/judge/calibration.h"

namespace gait {

namespace {
constexpr double usual_share = 0.98;  // of held-out frames
}

std::vector<Fold> deal_by_style(const std::vector<ObservedSequence>& sequences, int folds) {
  std::vector<int> order(sequences.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return sequences[a].style < sequences[b].style; });
  std::vector<Fold> dealt(folds);
  for (std::size_t i = 0; i < order.size(); ++i) dealt[i % folds].push_back(order[i]);
  return dealt;
}

std::vector<int> subjects_of(const LearningTask& task,
                             const std::vector<ObservedSequence>& sequences) {
  std::vector<std::string> names;
  std::vector<int> numbers;
  for (const ObservedSequence& sequence : sequences) {
    const std::string& name = task.sequences[sequence.source].subject;
    auto at = std::ranges::find(names, name);
    if (at == names.end()) at = names.insert(at, name);
    numbers.push_back(static_cast<int>(at - names.begin()));
  }
  return numbers;
}

std::vector<Fold> deal_by_subject(const std::vector<int>& subjects, int folds) {
  const int count = subjects.empty() ? 0 : std::ranges::max(subjects) + 1;
  std::vector<Fold> dealt(std::min(count, folds));
  for (std::size_t i = 0; i < subjects.size(); ++i)
    dealt[subjects[i] % dealt.size()].push_back(static_cast<int>(i));
  return dealt;
}

HeldFigures figures_of(const std::vector<HeldOut>& folds, const std::vector<double>& weights,
                       const std::vector<int>& styles) {
  HeldFigures sums;
  double count = 0, styled = 0;
  for (const HeldOut& held : folds)
    for (std::size_t i = 0; i < held.played.size(); ++i) {
      const double weight = weights[held.sequence[i]];
      const int style = styles[held.sequence[i]];
      sums.error += weight * held.errors[i];
      sums.step_accuracy += weight * held.label_accuracies[i];
      count += weight;
      if (style < 0) continue;
      const PlayedSequence& played = held.played[i];
      double right = 0;
      for (int frame = played.begin; frame < played.end; ++frame) {
        int best = 0;
        played.style_posteriors.col(frame).maxCoeff(&best);
        right += best == style;
      }
      sums.style_accuracy += weight * right / std::max(1, played.end - played.begin);
      styled += weight;
    }
  if (count > 0) sums.error /= count, sums.step_accuracy /= count;
  if (styled > 0) sums.style_accuracy /= styled;
  return sums;
}

float usual_distance(std::vector<float>& distances) {
  const auto usual =
      distances.begin() +
      static_cast<std::ptrdiff_t>(usual_share * static_cast<double>(distances.size() - 1));
  std::nth_element(distances.begin(), usual, distances.end());
  return *usual;
}

void set_what_is_usual(Model& model, const std::vector<HeldOut>& folds,
                       const std::vector<int>& styles) {
  StyleScores scores;
  std::vector<float> distances;
  for (const HeldOut& held : folds)
    for (std::size_t i = 0; i < held.played.size(); ++i) {
      const PlayedSequence& played = held.played[i];
      const int style = styles[held.sequence[i]];
      for (int frame = played.begin; frame < played.end; ++frame) {
        distances.push_back(played.decisions[frame].distance);
        if (style < 0) continue;
        scores.scores.push_back(played.style_posteriors.col(frame).array().max(1e-30f).log() /
                                static_cast<float>(probing_temper));
        scores.truth.push_back(style);
      }
    }
  PlayDefaults& play = model.play;
  if (!distances.empty()) play.usual_distance = std::max(1e-3f, usual_distance(distances));
  play.style_temper = best_temper(scores, play.style_temper);
  CalibrationError calibration;
  for (std::size_t i = 0; i < scores.truth.size(); ++i) {
    const Eigen::ArrayXd tempered = play.style_temper * scores.scores[i].array().cast<double>();
    int best = 0;
    const double largest = tempered.maxCoeff(&best);
    calibration.add(1 / (tempered - largest).exp().sum(), best == scores.truth[i]);
  }
  model.training.validated_calibration_error = calibration.value();
}

}  // namespace gait
