#include "gait/judge/model_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>

#include "gait/error.h"
#include "gait/judge/folds.h"
#include "gait/learn/parallel.h"
#include "gait/learn/phase_statistics.h"

namespace gait {

namespace {

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
    subjects_ = subjects_of(task_, learnt_.observed.sequences);
    if (const int subjects = std::ranges::max(subjects_) + 1; subjects > 1)
      selected_.subjects = subjects;
    if (selected_.folds < 2) {
      selected_.folds = 0;
      return finish(regularisation, options_.regularisation
                                        ? "given"
                                        : "default: a single sequence cannot be validated");
    }
    if (!options_.regularisation) regularisation = choose_regularisation(rounds);
    if (!options_.rounds) choose_rounds(regularisation);
    if (selected_.subjects > 0 && task_.body) choose_hips_frame(regularisation);
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

  // Those that choices are made by.
  void gather_folds(const Learnt& learnt) {
    gather_folds(learnt, selected_.subjects > 0 ? deal_by_subject(subjects_, options_.subject_folds)
                                                : clip_folds());
  }

  std::vector<Fold> clip_folds() const {
    return deal_by_style(learnt_.observed.sequences, selected_.folds);
  }

  void gather_folds(const Learnt& learnt, std::vector<Fold> dealt) {
    folds_ = std::move(dealt);
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
  HeldOut play_held_out(const Learnt& learnt, int fold, double regularisation,
                        const PlayDefaults& play, std::optional<double> hips_frame = {}) const {
    auto model = std::make_shared<Model>(learnt.model);
    model->play = play;
    model->play.trust.reset();  // what is usual is not known yet
    if (hips_frame) model->body->hips_frame = *hips_frame;
    const auto rest = without(all_statistics_, fold_statistics_[fold]);
    HeldOut held;
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
    std::vector<std::vector<std::pair<int, double>>> errors(choices.size());  // with the sequence
    std::mutex adding;
    in_parallel(static_cast<int>(choices.size()) * folds, options_.learning.hmm.threads,
                [&](int job) {
                  if (options_.learning.hmm.cancel.requested()) throw Error("cancelled");
                  const std::size_t choice = job / folds;
                  const HeldOut held = play(choices[choice], job % folds);
                  const std::scoped_lock lock(adding);
                  for (std::size_t i = 0; i < held.errors.size(); ++i)
                    errors[choice].emplace_back(held.sequence[i], held.errors[i]);
                });
    std::vector<double> means;
    for (auto& of_choice : errors) {
      // Sorted, so that the order in which folds ended does not change the sum.
      std::sort(of_choice.begin(), of_choice.end());
      means.push_back(mean_of(of_choice));
    }
    return means;
  }

  // Over sequences or, where subjects are left out, over the subjects' own means. Infinite when
  // none held out could be played: nothing speaks for this choice.
  double mean_of(const std::vector<std::pair<int, double>>& errors) const {
    if (errors.empty()) return std::numeric_limits<double>::infinity();
    std::vector<double> sums(std::max(1, selected_.subjects), 0.0), counts(sums.size(), 0.0);
    for (const auto& [sequence, error] : errors) {
      const std::size_t of = selected_.subjects > 0 ? subjects_[sequence] : 0;
      sums[of] += error, counts[of] += 1;
    }
    double sum = 0, heard = 0;
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (counts[i] > 0) sum += sums[i] / counts[i], heard += 1;
    return sum / heard;
  }

  double choose_regularisation(int rounds) {
    report(0.3, "cross-validating the regularisation");
    gather_folds(learnt_);
    const auto errors = errors_of(options_.regularisations, [&](double kappa, int fold) {
      return play_held_out(learnt_, fold, kappa, learnt_.model.play);
    });
    for (std::size_t i = 0; i < errors.size(); ++i)
      add_trial(options_.regularisations[i], rounds, learnt_.model, errors[i]);
    const auto best = std::min_element(errors.begin(), errors.end()) - errors.begin();
    // Where labels occur in one sequence only nothing can be held out.
    return std::isfinite(errors[best]) ? options_.regularisations[best]
                                       : options_.learning.hmm.regularisation;
  }

  void add_trial(double regularisation, int rounds, const Model& model, double error) {
    selected_.trials.push_back(
        {regularisation, rounds, model.body ? model.body->hips_frame : 0, error});
  }

  // By how much bodies' frames of the hips differ, from what strangers' legs show of it.
  void choose_hips_frame(double regularisation) {
    report(0.88, "cross-validating the hips' frame");
    gather_folds(learnt_);
    const auto errors = errors_of(options_.hips_frames, [&](double hips_frame, int fold) {
      return play_held_out(learnt_, fold, regularisation, learnt_.model.play, hips_frame);
    });
    double& chosen = learnt_.model.body->hips_frame;
    const auto best = std::min_element(errors.begin(), errors.end()) - errors.begin();
    const int rounds = static_cast<int>(learnt_.states.log_likelihood.size());
    for (std::size_t i = 0; i < errors.size(); ++i)
      selected_.trials.push_back({regularisation, rounds, options_.hips_frames[i], errors[i]});
    if (std::isfinite(errors[best])) chosen = options_.hips_frames[best];
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
      add_trial(regularisation, rounds, candidate.model, error);
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
    std::vector<HeldOut> folds = play_folds(regularisation, untempered);
    set_what_is_usual(learnt_.model, folds, judged_styles());
    Training& training = learnt_.model.training;
    if (selected_.subjects > 0) {
      const HeldFigures strangers = figures_of(folds, weights(false), judged_styles());
      training.strangers_error = strangers.error;
      training.strangers_step_accuracy = strangers.step_accuracy;
      gather_folds(learnt_, clip_folds());
      folds = play_folds(regularisation, untempered);
    }
    const HeldFigures known = figures_of(folds, weights(selected_.subjects > 0), judged_styles());
    training.validated_error = known.error;
    training.validated_step_accuracy = known.step_accuracy;
    training.validated_style_accuracy = known.style_accuracy;
  }

  std::vector<HeldOut> play_folds(double regularisation, const PlayDefaults& play) const {
    std::vector<HeldOut> folds(folds_.size());
    in_parallel(static_cast<int>(folds.size()), options_.learning.hmm.threads, [&](int fold) {
      folds[fold] = play_held_out(learnt_, fold, regularisation, play);
    });
    return folds;
  }

  // Per sequence, how much it counts: all alike or, of strangers, each of these alike; with
  // `only_known` those alone whose subject is known from another fold.
  std::vector<double> weights(bool only_known) const {
    std::vector<double> weights(subjects_.size(), 1.0);
    for (std::size_t fold = 0; fold < folds_.size(); ++fold)
      for (const int sequence : folds_[fold]) {
        if (only_known)
          weights[sequence] = known_elsewhere(sequence, fold) ? 1 : 0;
        else if (selected_.subjects > 0)
          weights[sequence] =
              1.0 / static_cast<double>(std::ranges::count(subjects_, subjects_[sequence]));
      }
    return weights;
  }

  // Per sequence, its style, if that is taught by other folds, too; else -1.
  std::vector<int> judged_styles() const {
    std::vector<int> styles(subjects_.size(), -1);
    for (std::size_t fold = 0; fold < folds_.size(); ++fold)
      for (const int sequence : folds_[fold]) {
        const int style = learnt_.observed.sequences[sequence].style;
        if (style >= 0 && taught_elsewhere(style, static_cast<int>(fold))) styles[sequence] = style;
      }
    return styles;
  }

  // Whether another fold has a sequence of the same subject.
  bool known_elsewhere(int sequence, std::size_t fold) const {
    const auto of_subject = [&](int other) { return subjects_[other] == subjects_[sequence]; };
    return std::ranges::count(subjects_, subjects_[sequence]) >
           std::ranges::count_if(folds_[fold], of_subject);
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

  const LearningTask& task_;
  const SelectionOptions& options_;
  Learnt learnt_;
  std::vector<Fold> folds_;
  std::vector<int> subjects_;  // per observed sequence
  std::vector<std::vector<StateStatistics>> fold_statistics_;
  std::vector<StateStatistics> all_statistics_;
  Selected selected_;
};

}  // namespace

Selected select_model(const LearningTask& task, const SelectionOptions& options) {
  return Selection(task, options).run();
}

}  // namespace gait
