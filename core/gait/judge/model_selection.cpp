#include "gait/judge/model_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>

#include "gait/error.h"
#include "gait/judge/calibration.h"
#include "gait/judge/played_sequence.h"
#include "gait/learn/parallel.h"
#include "gait/learn/phase_statistics.h"

namespace gait {

namespace {

// Sequences dealt to folds style by style, so that each fold has some of every style.
std::vector<std::vector<int>> deal(const std::vector<ObservedSequence>& sequences, int folds) {
  std::vector<int> order(sequences.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return sequences[a].style < sequences[b].style; });
  std::vector<std::vector<int>> dealt(folds);
  for (std::size_t i = 0; i < order.size(); ++i) dealt[i % folds].push_back(order[i]);
  return dealt;
}

// What playing held-out sequences showed.
struct Held {
  std::vector<double> errors;  // mean over frames, per sequence
  std::vector<double> label_accuracies;
  std::vector<PlayedSequence> played;
  std::vector<int> sequence;
};

class Selection {
 public:
  Selection(const LearningTask& task, const SelectionOptions& options)
      : task_(task), options_(options) {}

  Selected run() {
    const int rounds = options_.rounds.value_or(options_.learning.hmm.soft_iterations);
    double regularisation = options_.regularisation.value_or(options_.learning.hmm.regularisation);
    learnt_ = learn_with(rounds, regularisation, 0, 0.3);
    selected_.folds =
        std::min<int>(options_.folds, static_cast<int>(learnt_.observed.sequences.size()));
    if (selected_.folds < 2) {
      selected_.folds = 0;
      return finish(regularisation, options_.regularisation
                                        ? "given"
                                        : "default: a single sequence cannot be validated");
    }
    if (!options_.regularisation) regularisation = choose_regularisation(rounds);
    if (!options_.rounds) choose_rounds(regularisation);
    calibrate(regularisation);
    return finish(regularisation, options_.regularisation ? "given" : "cross-validation");
  }

 private:
  // Reports its own progress as the part from `begin` to `end` of the whole.
  Learnt learn_with(int rounds, double regularisation, double begin, double end) {
    LearningOptions learning = options_.learning;
    if (learning.hmm.progress)
      learning.hmm.progress = [this, begin, end](double share, const std::string& what) {
        options_.learning.hmm.progress(begin + share * (end - begin), what);
      };
    learning.hmm.soft_iterations = rounds;
    learning.hmm.regularisation = regularisation;
    Learnt learnt = learn(task_, learning);
    learnt.model.play.decoder = options_.decoder;
    return learnt;
  }

  void report(double share, const char* what) const {
    const HmmOptions& hmm = options_.learning.hmm;
    if (hmm.cancel.requested()) throw Error("cancelled");
    if (hmm.progress) hmm.progress(share, what);
  }

  // Statistics of all sequences but one fold's.
  static std::vector<StateStatistics> without(const std::vector<StateStatistics>& all,
                                              const std::vector<StateStatistics>& fold) {
    std::vector<StateStatistics> rest = all;
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= fold[i];
    return rest;
  }

  void gather_folds(const Learnt& learnt) {
    folds_ = deal(learnt.observed.sequences, selected_.folds);
    fold_statistics_.clear();
    const int styles = static_cast<int>(task_.styles.size());
    for (const auto& fold : folds_)
      fold_statistics_.push_back(gather(learnt.observed.sequences, learnt.states.alignments, fold,
                                        learnt.table.total, styles, options_.learning.hmm.threads));
    all_statistics_ = fold_statistics_.front();
    for (std::size_t fold = 1; fold < folds_.size(); ++fold)
      for (std::size_t i = 0; i < all_statistics_.size(); ++i)
        all_statistics_[i] += fold_statistics_[fold][i];
  }

  // Plays one fold's sequences by a model that has not seen them.
  Held play_held_out(const Learnt& learnt, int fold, double regularisation,
                     const PlayDefaults& play) const {
    auto model = std::make_shared<Model>(learnt.model);
    model->play = play;
    const auto rest = without(all_statistics_, fold_statistics_[fold]);
    Held held;
    for (const StateStatistics& state : rest)
      if (state.count < 1) return held;  // a state that only this fold has passed through
    set_states(*model, learnt.table, rest, learnt.states.stay, learnt.states.target, regularisation,
               options_.learning.placement);
    const PlayModel played_model(model);
    for (const int index : folds_[fold]) {
      const Sequence& sequence = task_.sequences[learnt.observed.sequences[index].source];
      PlayedSequence played = play_sequence(played_model, {}, sequence);
      double error = 0, right = 0;
      for (int frame = played.begin; frame < played.end; ++frame) {
        error +=
            stream_errors(*model, played.outputs.col(frame), sequence.outputs.col(frame)).mean();
        right += played.decisions[frame].label == played.true_label[frame];
      }
      const double frames = std::max(1, played.end - played.begin);
      held.errors.push_back(error / frames);
      held.label_accuracies.push_back(right / frames);
      held.played.push_back(std::move(played));
      held.sequence.push_back(index);
    }
    return held;
  }

  // Mean error over held-out sequences of each candidate.
  template <typename Choice, typename Play>
  std::vector<double> errors_of(const std::vector<Choice>& choices, Play play) {
    const int folds = static_cast<int>(folds_.size());
    std::vector<std::vector<double>> errors(choices.size());
    std::mutex adding;
    in_parallel(
        static_cast<int>(choices.size()) * folds, options_.learning.hmm.threads, [&](int job) {
          if (options_.learning.hmm.cancel.requested()) throw Error("cancelled");
          const std::size_t choice = job / folds;
          const Held held = play(choices[choice], job % folds);
          const std::scoped_lock lock(adding);
          errors[choice].insert(errors[choice].end(), held.errors.begin(), held.errors.end());
        });
    std::vector<double> means;
    for (auto& of_choice : errors) {
      // Sorted, so that the order in which folds ended does not change the sum.
      std::sort(of_choice.begin(), of_choice.end());
      // None held out could be played: nothing speaks for this choice.
      means.push_back(of_choice.empty() ? std::numeric_limits<double>::infinity()
                                        : std::accumulate(of_choice.begin(), of_choice.end(), 0.0) /
                                              static_cast<double>(of_choice.size()));
    }
    return means;
  }

  double choose_regularisation(int rounds) {
    report(0.3, "cross-validating the regularisation");
    gather_folds(learnt_);
    const auto errors = errors_of(options_.regularisations, [&](double kappa, int fold) {
      return play_held_out(learnt_, fold, kappa, learnt_.model.play);
    });
    for (std::size_t i = 0; i < errors.size(); ++i)
      selected_.trials.push_back({options_.regularisations[i], rounds, errors[i]});
    const auto best = std::min_element(errors.begin(), errors.end()) - errors.begin();
    // Where labels occur in one sequence only nothing can be held out.
    return std::isfinite(errors[best]) ? options_.regularisations[best]
                                       : options_.learning.hmm.regularisation;
  }

  void choose_rounds(double regularisation) {
    report(0.6, "cross-validating the rounds of Baum-Welch");
    double best = -1;
    std::size_t candidate_number = 0;
    Learnt best_learnt;
    for (const int rounds : options_.round_choices) {
      const double tried = static_cast<double>(candidate_number++) /
                           static_cast<double>(options_.round_choices.size());
      Learnt candidate = learn_with(rounds, regularisation, 0.6 + 0.3 * tried, 0.6 + 0.3 * tried);
      gather_folds(candidate);
      const double error =
          errors_of(std::vector<double>{regularisation}, [&](double kappa, int fold) {
            return play_held_out(candidate, fold, kappa, candidate.model.play);
          }).front();
      selected_.trials.push_back({regularisation, rounds, error});
      if (best < 0 || error < best) best = error, best_learnt = std::move(candidate);
    }
    learnt_ = std::move(best_learnt);
  }

  // The temper of the filter, then the styles' temper and what the model is worth on new data.
  void calibrate(double regularisation) {
    report(0.9, "calibrating");
    gather_folds(learnt_);
    PlayDefaults& play = learnt_.model.play;
    const auto errors = errors_of(options_.tempers, [&](double temper, int fold) {
      PlayDefaults tempered = play;
      tempered.decoder = DecoderKind::forward;
      tempered.temper = temper;
      return play_held_out(learnt_, fold, regularisation, tempered);
    });
    const auto best = std::min_element(errors.begin(), errors.end()) - errors.begin();
    if (std::isfinite(errors[best])) play.temper = options_.tempers[best];

    // With a temper of one the logarithm of a posterior is the score but for a constant.
    PlayDefaults untempered = play;
    untempered.style_temper = probing_temper;
    std::vector<Held> folds(folds_.size());
    in_parallel(static_cast<int>(folds.size()), options_.learning.hmm.threads, [&](int fold) {
      folds[fold] = play_held_out(learnt_, fold, regularisation, untempered);
    });
    validate(folds);
  }

  void validate(const std::vector<Held>& folds) {
    StyleScores scores;
    std::vector<float> distances;
    double error = 0, accuracy = 0, count = 0, right_styles = 0, styled = 0;
    for (std::size_t fold = 0; fold < folds.size(); ++fold)
      for (std::size_t i = 0; i < folds[fold].played.size(); ++i) {
        error += folds[fold].errors[i];
        accuracy += folds[fold].label_accuracies[i];
        count += 1;
        const PlayedSequence& played = folds[fold].played[i];
        for (int frame = played.begin; frame < played.end; ++frame)
          distances.push_back(played.decisions[frame].distance);
        const int style = learnt_.observed.sequences[folds[fold].sequence[i]].style;
        if (style < 0 || !taught_elsewhere(style, static_cast<int>(fold))) continue;
        double right = 0;
        for (int frame = played.begin; frame < played.end; ++frame) {
          const Eigen::VectorXf posterior = played.style_posteriors.col(frame);
          scores.scores.push_back(posterior.array().max(1e-30f).log() /
                                  static_cast<float>(probing_temper));
          scores.truth.push_back(style);
          int best = 0;
          posterior.maxCoeff(&best);
          right += best == style;
        }
        right_styles += right / std::max(1, played.end - played.begin);
        styled += 1;
      }
    Training& training = learnt_.model.training;
    training.validated_error = count > 0 ? error / count : 0;
    training.validated_step_accuracy = count > 0 ? accuracy / count : 0;
    training.validated_style_accuracy = styled > 0 ? right_styles / styled : 0;
    PlayDefaults& play = learnt_.model.play;
    if (!distances.empty()) {
      const auto usual =
          distances.begin() +
          static_cast<std::ptrdiff_t>(usual_share * static_cast<double>(distances.size() - 1));
      std::nth_element(distances.begin(), usual, distances.end());
      play.usual_distance = std::max(1e-3f, *usual);
    }
    play.style_temper = best_temper(scores, play.style_temper);
    CalibrationError calibration;
    for (std::size_t i = 0; i < scores.truth.size(); ++i) {
      const Eigen::ArrayXd tempered = play.style_temper * scores.scores[i].array().cast<double>();
      int best = 0;
      const double largest = tempered.maxCoeff(&best);
      calibration.add(1 / (tempered - largest).exp().sum(), best == scores.truth[i]);
    }
    training.validated_calibration_error = calibration.value();
  }

  bool taught_elsewhere(int style, int fold) const {
    for (const StateStatistics& all : all_statistics_) {
      const auto& mine = fold_statistics_[fold][&all - all_statistics_.data()];
      if (all.style_counts[style] - mine.style_counts[style] < 1) return false;
    }
    return true;
  }

  Selected finish(double regularisation, const char* by) {
    set_states(learnt_.model, learnt_.table, learnt_.states.statistics, learnt_.states.stay,
               learnt_.states.target, regularisation, options_.learning.placement);
    set_phases(learnt_.model, task_.sequences, learnt_.observed, learnt_.table,
               learnt_.states.alignments, regularisation);
    learnt_.model.training.regularisation = regularisation;
    learnt_.model.training.regularisation_chosen_by = by;
    selected_.model = std::move(learnt_.model);
    report(1, "done");
    return std::move(selected_);
  }

  // Small enough that posteriors stay above the least float, so that scores come back from them.
  static constexpr double probing_temper = 0.01;
  static constexpr double usual_share = 0.98;  // of held-out frames

  const LearningTask& task_;
  const SelectionOptions& options_;
  Learnt learnt_;
  std::vector<std::vector<int>> folds_;
  std::vector<std::vector<StateStatistics>> fold_statistics_;
  std::vector<StateStatistics> all_statistics_;
  Selected selected_;
};

}  // namespace

Selected select_model(const LearningTask& task, const SelectionOptions& options) {
  return Selection(task, options).run();
}

}  // namespace gait
