// What is learnt: plain data, no behaviour. `learn` makes it, `play` reads it, model_file keeps it.
//
// A model joins input streams to output streams by labels, each a left-to-right HMM whose states
// hold one Gaussian over z = [x; y] (T14 §3). Steps of a walk are the default instance: labels
// `right` and `left` that follow each other, streams that are joint rotations. Nothing here needs
// two labels, or a body.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "gait/model/cycle_space.h"
#include "gait/motion/hinge.h"
#include "gait/motion/joint_roles.h"
#include "gait/motion/observation.h"
#include "gait/motion/skeleton.h"

namespace gait {

enum class StreamKind {
  rotation,  // three values, the rotation vector of a joint relative to its reference, radians
  plain      // any number of values in the stream's own unit
};

struct Stream {
  std::string name;
  int size = 3;  // values per frame
  StreamKind kind = StreamKind::rotation;
};

int values_of(const std::vector<Stream>& streams);

struct State {
  // Gaussian over z = [x; y], scaled; x has model.input.size() entries, y model.output.size().
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  double stay = 0.5;    // probability of staying for another frame
  double duration = 0;  // mean time spent here, seconds
  double weight = 0;    // how many frames it was learnt from
  // Where labels follow each other in a ring: the phase of the cycle, 0 to 1, that the body was at
  // `input.mean_age()` frames before a frame of this state, and its covariance with x, in cycles.
  // Empty elsewhere, and in models of before there were any.
  double phase = 0;
  Eigen::VectorXd phase_covariance{};
  Eigen::MatrixXd style_means;       // z by styles: per-style means, scaled
  Eigen::MatrixXd style_covariance;  // of x within styles, shared by all styles
  // What a walk without input follows (T14 §4.3), unscaled: the inputs' values that move, then the
  // outputs'; after all of them their centred first, then second differences. Means per style (one
  // column without styles), variances within styles. Empty in models of before there were any.
  Eigen::MatrixXd trajectory_means;
  Eigen::VectorXd trajectory_variances;
};

struct Label {
  std::string name;
  std::vector<int> successors;       // indices of the labels that may follow
  std::vector<State> states;         // left to right, no skips
  double duration = 0;               // mean time from its begin to its end, seconds
  double duration_deviation = 0;     // seconds
  double shortest = 0, longest = 0;  // seconds, as seen in training
  // Mean per style, seconds; 0 for a style that never had this label. Empty without styles.
  Eigen::VectorXd style_durations{};
};

// The body behind rotation streams.
struct Body {
  Skeleton skeleton;                             // metres, Y up
  std::vector<Role> roles;                       // one per joint
  std::vector<Eigen::Quaterniond> references;    // per joint, chordal mean over the training clips
  std::vector<int> input_joints, output_joints;  // indices, in the order of the streams
  double heading_window = 1.1;                   // seconds in a cycle: window of the causal heading
  // Deviation per axis, radians, by which another body's frame of the hips may lie otherwise. The
  // states' covariances are without it: it comes on top where they are played (model/hips_frame.h).
  double hips_frame = 0;
  // Knees and elbows with the angles that they had in training. Empty in models of before there
  // were any.
  std::vector<Hinge> hinges{};
};

enum class DecoderKind { viterbi, forward, lag };

// Defaults of playing the model; some are chosen by cross-validation.
struct PlayDefaults {
  DecoderKind decoder = DecoderKind::forward;
  double lag = 0.1;     // seconds, for DecoderKind::lag
  double temper = 0.1;  // exponent on emissions in the forward filter
  // Seconds of state queue before the current frame (P); none: all frames since the motion began.
  std::optional<double> past;
  double future = 0;  // seconds after it (F)
  // Factor on the variances of differences where a trajectory is solved. The equations suppose that
  // the errors of statics and differences are independent; they are not, so 1 smooths too much.
  double easing = 1;
  double strength = 1;  // of the mapping
  // Up to so many times the usual distance (below) an observation is mapped with all the strength;
  // beyond, strength falls with the square of its distance. None: never.
  std::optional<double> trust;
  double style_memory = 1;     // seconds over which style scores leak
  double style_temper = 0.02;  // exponent on style likelihoods
  // Decision::distance that 98 % of what was held out stayed below: beyond it, a motion is unlike
  // what was taught.
  double usual_distance = 1.25;
};

// How the model came about and how good it is, for `gait info`.
struct Training {
  std::string date, comment;
  std::vector<std::string> clips;
  std::vector<std::string> subjects;  // of the clips that name one, each once
  double regularisation = 30;         // kappa
  // What covariances were shrunk towards and by what the sensors' placement was widened: with kappa
  // and the states' weights, all that later frames need to be merged in. Empty in models of before.
  Eigen::VectorXd target;  // diagonal of T, over z
  double placement = 0;    // radians
  std::string regularisation_chosen_by;
  std::vector<double> log_likelihood, penalised_log_likelihood;  // per iteration
  double validated_error = 0;          // mean angle of output joints on held-out clips, radians
  double validated_step_accuracy = 0;  // shares, 0 when not validated
  double validated_style_accuracy = 0;
  double validated_calibration_error = 0;
  // The same of people left out, where clips name their subjects: all that the figures above mean
  // is then people whom the model knows. 0 when not validated.
  double strangers_error = 0, strangers_step_accuracy = 0;
  bool synthetic = false;
};

struct Model {
  std::string name;
  double frame_rate = 30;  // frames per second of everything below
  std::vector<Stream> inputs, outputs;
  InputLayout input;
  OutputLayout output;
  Scaling input_scaling, output_scaling;
  Eigen::VectorXd output_mean;  // one per output value: what unmodelled ones are set to
  Eigen::VectorXd input_mean;   // the same per input value; empty where trajectory_means are
  std::vector<Label> labels;
  std::vector<std::string> styles;
  std::optional<Body> body;
  // Spaces of cycles, only with a body: all styles in one (T10), each subject over speed (G04), and
  // all subjects in one, so that one can be moved towards another.
  std::optional<StyleSpace> style_space;
  std::vector<SpeedSpace> speed_spaces;
  std::optional<CycleSpace> shared_speed_space;
  PlayDefaults play;
  Training training;

  // Values of a frame that move, inputs' then outputs': what trajectory_means speak of.
  int trajectory_values() const { return input.statics() + output.statics(); }
  // Whether its states say where in a cycle they are.
  bool has_phases() const {
    return !labels.empty() && !labels.front().states.empty() &&
           labels.front().states.front().phase_covariance.size() > 0;
  }
  int states() const {
    int count = 0;
    for (const Label& label : labels) count += static_cast<int>(label.states.size());
    return count;
  }
};

}  // namespace gait
