// Walks over speed: per subject a space of its cycles and regression lines of their scores over
// speed (G04 §3.2-4.1) and, beyond the paper, one space of all subjects (its §6).
#pragma once

#include <string>
#include <vector>

#include "gait/learn/cycles.h"
#include "gait/learn/frequency_law.h"
#include "gait/learn/principal_components.h"
#include "gait/learn/walk_sequences.h"
#include "gait/model/cycle_space.h"
#include "gait/model/model.h"

namespace gait {

struct SpeedOptions {
  int frames = 100;                            // per cycle (G04 §5)
  ComponentChoice components{0.8, 0};          // of each subject's own space (G04 §4.1)
  ComponentChoice shared_components{0.99, 0};  // of the space of all
  // Strength with which a subject's slope is held to the slope that all subjects share, in cycles
  // times V squared. A subject with one speed takes the shared slope, one with many keeps its own.
  double held_to_shared_slope = 0.3;
  double held_to_shared_law = 0.3;  // the same for the frequency law, in cycles times (log V)^2
  RoleTable roles;
};

// Everything that is learnt about speed, as the model stores it.
struct SpeedSpaces {
  std::vector<SpeedSpace> subjects;  // sorted by name; `shared` is filled where there are several
  std::optional<CycleSpace> shared;
  FrequencyLaw law;                      // of all subjects' cycles together (G04 eq. 6, fig. 7)
  std::vector<CadencePoint> law_points;  // what it was fitted to, subject after subject
};

// Cycles of one subject, and its standing pose: one pose vector, empty when it was not captured.
struct SubjectCycles {
  std::string subject;
  double leg_length = 0;  // thigh + shank, metres
  std::vector<CapturedCycle> cycles;
  Eigen::VectorXd standing;
};

// A body for walks of several subjects: the skeleton of the subject with most walks, references
// over all walks. For models that hold walks over speed alone; other models have their own body.
Body body_of_subjects(const std::vector<Walk>& walks, const RoleTable& roles = {});

// Cuts the cycles of each subject on its own bones, because bodies of one rig differ in the breadth
// of the pelvis or the length of the back. Walks without a subject belong to one named "anyone".
// Clips with "stand" in their name give the standing pose. Only straight cycles are used where
// there are any. Throws Error when joints are missing or their rest pose is that of another rig.
std::vector<SubjectCycles> cycles_of_subjects(const std::vector<Walk>& walks, const Body& body,
                                              const SpeedOptions& options = {});

// Throws Error when there is no cycle at all.
SpeedSpaces learn_speed_spaces(const std::vector<SubjectCycles>& subjects, const Body& body,
                               const SpeedOptions& options = {});

}  // namespace gait
