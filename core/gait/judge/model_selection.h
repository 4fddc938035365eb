// Model selection: learns a model and finds what was not said by cross-validation over sequences:
// the regularisation, the rounds of Baum-Welch, the hips' frame, the filter's temper, the styles'
// calibration.
//
// Where sequences name two subjects or more, folds leave subjects out, and what is chosen is what
// serves strangers: folds that mix subjects choose too little regularisation, and promise what
// strangers do not get.
//
// Statistics of states add up (learn/state_statistics), so a fold is left out by subtraction; the
// alignments, the scaling and the target T are those of all sequences.
#pragma once

#include <optional>
#include <vector>

#include "gait/learn/trainer.h"

namespace gait {

struct SelectionOptions {
  LearningOptions learning;              // its regularisation and rounds serve where none is chosen
  std::optional<double> regularisation;  // said: not chosen
  std::optional<int> rounds;             // of Baum-Welch; said: not chosen
  DecoderKind decoder = DecoderKind::viterbi;
  std::vector<double> regularisations{3, 10, 30, 100, 300, 1000, 3000};
  std::vector<int> round_choices{0, 1, 4};
  std::vector<double> tempers{0.03, 0.1, 0.3, 1};
  // Deviations of the hips' frame, radians; only tried where subjects are left out.
  std::vector<double> hips_frames{0, 0.05, 0.1, 0.15, 0.2};
  int folds = 5;           // at most; never more than sequences
  int subject_folds = 10;  // at most; never more than subjects
};

// One choice that was tried, and the mean error of output streams on held-out sequences (radians
// for rotations): mean over sequences or, where subjects are left out, over these.
struct Trial {
  double regularisation = 0;
  int rounds = 0;
  double hips_frame = 0;  // radians
  double error = 0;
};

struct Selected {
  Model model;
  std::vector<Trial> trials;
  int folds = 0;     // 0: too few sequences, nothing was validated
  int subjects = 0;  // how many were left out, one fold after the other; 0: clips were
};

// Throws Error as learn() does, and Error("cancelled").
Selected select_model(const LearningTask& task, const SelectionOptions& options);

}  // namespace gait
