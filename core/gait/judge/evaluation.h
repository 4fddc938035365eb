// Evaluation: a model against the truth in captured clips; all the figures of `gait evaluate`.
//
// Means over clips and pooled over frames differ (slow walkers have long clips): both are given.
// Angles in radians, jerk in rad/s^3, slide in millimetres, times in microseconds.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gait/judge/contact_timing.h"
#include "gait/learn/walk_sequences.h"
#include "gait/play/stream_reconstructor.h"

namespace gait {

// How outputs are estimated: each way contains the one before and adds something.
enum class Estimate { mean_pose, state_means, mapped, synthesised };
inline constexpr std::array estimates{Estimate::mean_pose, Estimate::state_means, Estimate::mapped,
                                      Estimate::synthesised};
constexpr std::string_view estimate_name(Estimate estimate) {
  constexpr std::string_view names[] = {"mean pose", "state means", "mapped", "synthesised"};
  return names[static_cast<int>(estimate)];
}

// Sums over frames, from which both kinds of means come.
struct EvaluatedClip {
  std::string name, style;
  std::string subject;                       // empty: not named
  bool subject_known = false;                // the model was learnt from this subject, too
  int frames = 0;                            // between first and last contact
  double right_steps = 0, right_styles = 0;  // frames
  bool style_known = false;                  // the clip's style is one of the model's
  int best_style = -1;                       // over the whole clip
  // Per estimate and output stream: sum over frames of the angle to the truth.
  std::array<Eigen::VectorXd, 4> angle_sums;
  // Truth, mapped, synthesised: sum over frames of the joints' mean jerk.
  double jerk_truth = 0, jerk_mapped = 0, jerk_synthesised = 0;
  int jerk_frames = 0;
  // mm, sums over stances.
  double slide_captured = 0, slide_synthesised = 0;
  int stances = 0;
  // From the first to the last contact, metres; 0 where the clip did not travel.
  double path_captured = 0, path_synthesised = 0;
  ContactTiming timing;
};

// Whose movement is meant where the truth is measured, too.
enum class Source { truth, mapped, synthesised };

// Two means of one figure. NaN where there is nothing to average.
struct Means {
  double over_clips = 0;  // of the clips' own means
  double pooled = 0;      // over all frames (or stances) together
};

struct Evaluation {
  std::vector<EvaluatedClip> clips;
  std::vector<std::string> skipped;        // clips with too few steps, each with the reason
  std::vector<std::string> output_names;   // streams
  std::vector<bool> counted;               // streams in the mean error: all that move but the hips
  std::vector<std::string> styles;         // the model's
  Eigen::MatrixXi confusion;               // true style by recognised style, frames
  double calibration_error = 0;            // of style posteriors, 0 to 1
  std::vector<double> frame_microseconds;  // one per frame of all clips, ascending
  int delay_frames = 0;

  // Angle to the truth, mean over the counted streams; of the clips in one style if it is named.
  Means error(Estimate estimate, const std::string& style = {}) const;
  // The same of the clips of people whom the model was learnt from, or of others; clips that name
  // no subject are in neither.
  Means error_of_people(Estimate estimate, bool known) const;
  Means stream_error(Estimate estimate, int stream) const;  // angle
  Means step_accuracy() const;                              // share of frames
  Means style_accuracy() const;            // share of frames of the clips with a known style
  double style_accuracy_of_clips() const;  // share of clips; NaN without known styles
  Means jerk(Source source) const;         // of the counted streams
  Means foot_slide(Source source) const;   // per stance; of truth or synthesised
  Means path_ratio() const;                // root's path from the feet over the captured path
  // Contacts of all clips, or of those in one style.
  ContactErrors contacts(Heard heard, const std::string& style = {}) const;
  double frame_time(double quantile) const;  // microseconds; quantile 0 to 1
};

// What is asked beside how the model is played.
struct EvaluationOptions {
  SenderManner sender;  // how frames arrive where contacts are timed
  RoleTable roles;
};

// Plays each walk through the model and compares. Walks that have too few steps are skipped, saying
// so. `progress` is called before each walk with the share done; what it throws ends the work.
// Throws Error when a walk lacks the model's joints or when nothing is left.
Evaluation evaluate(std::shared_ptr<const Model> model, const std::vector<Walk>& walks,
                    const PlaySettings& settings, const EvaluationOptions& options = {},
                    const std::function<void(double)>& progress = {});

}  // namespace gait
