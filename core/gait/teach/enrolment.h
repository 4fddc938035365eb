// Enrolment: a few seconds of a stranger's whole-body walk merged into a model's states, without
// the data that the model was learnt from.
//
// A model keeps its states' counts N, means and covariances, and what these were shrunk towards
// (Training: kappa, target). Merging undoes the shrinkage, pools both sets of frames by weight, and
// shrinks again: at weight 1 this is training on both.
#pragma once

#include <vector>

#include "gait/learn/walk_sequences.h"
#include "gait/model/model.h"

namespace gait {

struct EnrolmentOptions {
  double seconds = 60;           // once whole cycles last so long, later ones are left
  std::optional<double> weight;  // of the stranger's frames; none: by their number (see below)
  RoleTable roles;
};

struct Enrolled {
  Model model;
  int cycles = 0;
  double seconds = 0;  // that they last
  // Mean angle of the output joints on cycles left out one by one, radians: by the model as it was,
  // and by the model enrolled on the others.
  double error_before = 0, error_after = 0;
  std::vector<std::string> left_out;  // clips without straight cycles, with the reason
};

// Merges the straight cycles of walks of one person. Their share of the enrolled model is
// T / (T + 5 s), T being the seconds they last. Styles and what walks alone move along. Throws
// Error, saying what was expected, when the model has no body, is no model of the steps right and
// left, or was made before models kept what merging needs; when the clips lack joints of the
// model, or have fewer than two whole cycles; when an option is out of its range; and when cycles
// left out one by one come out worse than by the model as it was.
Enrolled enrol(const Model& model, const std::vector<Walk>& walks,
               const EnrolmentOptions& options = {});

}  // namespace gait
