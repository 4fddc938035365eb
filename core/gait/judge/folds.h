// Folds: which sequences are left out together in cross-validation, and what playing them shows.
#pragma once

#include <vector>

#include "gait/judge/played_sequence.h"
#include "gait/learn/trainer.h"

namespace gait {

// Indices of the sequences that a fold leaves out.
using Fold = std::vector<int>;

// Sequences dealt to folds style by style, so that each fold has some of every style.
std::vector<Fold> deal_by_style(const std::vector<ObservedSequence>& sequences, int folds);

// One per observed sequence: which subject it is of, numbered as they come. Those without a name
// count as one subject.
std::vector<int> subjects_of(const LearningTask& task,
                             const std::vector<ObservedSequence>& sequences);

// All sequences of a subject in one fold; at most `folds` of them.
std::vector<Fold> deal_by_subject(const std::vector<int>& subjects, int folds);

// What playing one fold's sequences by a model that has not seen them showed.
struct HeldOut {
  std::vector<double> errors;  // mean over frames, per sequence
  std::vector<double> label_accuracies;
  std::vector<PlayedSequence> played;
  std::vector<int> sequence;  // which one
};

struct HeldFigures {  // means over sequences; 0 where there is nothing to average
  double error = 0, step_accuracy = 0, style_accuracy = 0;
};

// `weights`: how much each sequence counts; `styles`: the style of each, -1 where it is not judged.
HeldFigures figures_of(const std::vector<HeldOut>& folds, const std::vector<double>& weights,
                       const std::vector<int>& styles);

// Exponent on style likelihoods with which folds must have been played for what follows: small
// enough that posteriors stay above the least float, so that scores come back from them.
inline constexpr double probing_temper = 0.01;

// What 98 % of the distances (Decision::distance), of which there is one at least, stay below.
// Changes their order.
float usual_distance(std::vector<float>& distances);

// Sets how far a motion usually is from what was taught, and how much style scores are to be
// trusted.
void set_what_is_usual(Model& model, const std::vector<HeldOut>& folds,
                       const std::vector<int>& styles);

}  // namespace gait
