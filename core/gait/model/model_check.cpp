#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gait/error.h"
#include "gait/model/covariance_check.h"
#include "gait/model/cycle_space_check.h"
#include "gait/model/field_check.h"
#include "gait/model/model_file.h"

namespace gait {

namespace {

// Playing works in float and sizes its buffers by these; all are far above what bodies need.
constexpr double least_deviation_kept = 1e-9;
constexpr double least_variance_kept = 1e-14;
constexpr double longest_delay = 10;  // seconds of history, past, future, lag
constexpr int most_values = 100'000;  // in a frame of all streams
constexpr int most_states = 1000;     // over all labels

void check_streams(const std::vector<Stream>& streams, int values, const std::string& field) {
  int sum = 0;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const Stream& stream = streams[i];
    expect_text(stream.name, item(field, i) + ".name");
    if (stream.kind != StreamKind::rotation && stream.kind != StreamKind::plain)
      fail(item(field, i) + ".kind", "rotation or plain");
    if (stream.kind == StreamKind::rotation && stream.size != 3)
      fail(item(field, i) + ".size", "3, as rotations have, found " + std::to_string(stream.size));
    if (stream.size < 1 || stream.size > most_values - sum)
      fail(item(field, i) + ".size", "1 or more, and at most " + std::to_string(most_values) +
                                         " of all streams, found " + std::to_string(stream.size));
    sum += stream.size;
  }
  if (sum != values)
    fail(field,
         std::to_string(values) + " values, as the layout has, found " + std::to_string(sum));
}

void check_modelled(const std::vector<int>& modelled, int values, const std::string& field) {
  expect_indices(modelled, values, field);
  if (!std::ranges::is_sorted(modelled)) fail(field, "ascending indices");
}

void check_lags(const Model& model) {
  const std::vector<int>& lags = model.input.lags;
  for (std::size_t i = 0; i < lags.size(); ++i) {
    expect_within(lags[i], 1, longest_delay * model.frame_rate, item("input.lags", i));
    if (i > 0 && lags[i] <= lags[i - 1])
      fail(item("input.lags", i), "ascending frames, found " + std::to_string(lags[i]));
  }
}

void check_scaling(const Scaling& scaling, int size, const std::string& field) {
  expect_values(scaling.mean, size, 1, field + ".mean");
  expect_values(scaling.deviation, size, 1, field + ".deviation");
  if (!(scaling.deviation.array() >= least_deviation_kept).all())
    fail(field + ".deviation", "deviations above zero");
}

// All of a model's states have what walks without input need, or none: input_mean says which.
void check_trajectory(const State& state, const Model& model, const std::string& field) {
  const bool walks = model.input_mean.size() > 0;
  const int entries = walks ? 3 * model.trajectory_values() : 0;
  const auto columns = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(model.styles.size()));
  expect_values(state.trajectory_means, entries, walks ? columns : 0, field + ".trajectory_means");
  expect_values(state.trajectory_variances, entries, 1, field + ".trajectory_variances");
  if (walks && !(state.trajectory_variances.array() >= least_variance_kept).all())
    fail(field + ".trajectory_variances", "variances above zero");
}

void check_state(const State& state, const Model& model, const std::string& field,
                 CovarianceCheck& covariances) {
  const int inputs = model.input.size(), all = inputs + model.output.size();
  const auto styles = static_cast<Eigen::Index>(model.styles.size());
  const int style_inputs = styles == 0 ? 0 : inputs, style_all = styles == 0 ? 0 : all;
  expect_values(state.mean, all, 1, field + ".mean");
  expect_values(state.covariance, all, all, field + ".covariance");
  expect_values(state.style_means, style_all, styles, field + ".style_means");
  expect_values(state.style_covariance, style_inputs, style_inputs, field + ".style_covariance");
  covariances.expect(state.covariance, field + ".covariance");
  covariances.expect(state.style_covariance, field + ".style_covariance");
  check_trajectory(state, model, field);
  expect_values(state.phase_covariance, model.has_phases() ? inputs : 0, 1,
                field + ".phase_covariance");
  expect_within(state.phase, 0, 1, field + ".phase");
  if (!(state.stay > 0 && state.stay < 1))
    fail(field + ".stay", "a probability between 0 and 1, found " + std::to_string(state.stay));
  expect_seconds(state.duration, field + ".duration");
  expect_within(state.weight, 0, largest_number, field + ".weight");
}

void check_style_durations(const Label& label, const Model& model, const std::string& field) {
  const bool walks = model.input_mean.size() > 0;
  expect_values(label.style_durations, walks ? static_cast<Eigen::Index>(model.styles.size()) : 0,
                1, field + ".style_durations");
  for (const double seconds : label.style_durations)
    expect_seconds(seconds, field + ".style_durations");
}

void check_labels(const Model& model) {
  if (model.labels.empty()) fail("labels", "at least one, found none");
  std::vector<std::string> names;
  std::size_t states = 0;
  for (const Label& label : model.labels) {
    names.push_back(label.name);
    states += label.states.size();
  }
  expect_names(names, "labels");
  if (states > most_states)
    fail("labels",
         "at most " + std::to_string(most_states) + " states, found " + std::to_string(states));
  CovarianceCheck covariances;
  for (std::size_t i = 0; i < model.labels.size(); ++i) {
    const Label& label = model.labels[i];
    const std::string field = item("labels", i);
    expect_indices(label.successors, static_cast<int>(model.labels.size()), field + ".successors");
    expect_seconds(label.duration, field + ".duration");
    expect_seconds(label.duration_deviation, field + ".duration_deviation");
    expect_seconds(label.shortest, field + ".shortest");
    expect_within(label.longest, label.shortest, largest_number, field + ".longest");
    if (label.states.empty()) fail(field + ".states", "at least one, found none");
    for (std::size_t k = 0; k < label.states.size(); ++k)
      check_state(label.states[k], model, item(field + ".states", k), covariances);
    check_style_durations(label, model, field);
  }
}

void check_joints(const Body& body) {
  const std::size_t joints = body.skeleton.joints.size();
  if (joints == 0) fail("body.joints", "at least one, found none");
  if (body.roles.size() != joints || body.references.size() != joints)
    fail("body", "a role and a reference per joint");
  for (std::size_t i = 0; i < joints; ++i) {
    const Joint& joint = body.skeleton.joints[i];
    const std::string field = item("body.joints", i);
    expect_text(joint.name, field + ".name");
    if (joint.parent < -1 || joint.parent >= static_cast<int>(i))
      fail(field + ".parent",
           "-1 or a joint before this one, found " + std::to_string(joint.parent));
    expect_values(joint.offset, 3, 1, field + ".offset");
    for (std::size_t tip = 0; tip < joint.tips.size(); ++tip)
      expect_values(joint.tips[tip], 3, 1, item(field + ".tips", tip));
    if (body.roles[i] < Role::none || body.roles[i] > Role::right_toes)
      fail(field + ".role", "a joint's role");
    if (!(std::abs(body.references[i].norm() - 1) < 1e-6))
      fail(field + ".reference", "a unit quaternion");
  }
}

void check_hinges(const Body& body) {
  const auto is_below = [&](int joint, int above) {
    return joint < body.skeleton.size() && joint != above &&
           body.skeleton.is_in_branch(joint, above);
  };
  std::vector<int> joints;
  for (std::size_t i = 0; i < body.hinges.size(); ++i) {
    const Hinge& hinge = body.hinges[i];
    const std::string field = item("body.hinges", i);
    if (!is_below(hinge.joint, hinge.above) ||
        (hinge.below == -1 ? body.skeleton.joints[hinge.joint].tips.empty()
                           : !is_below(hinge.below, hinge.joint)))
      fail(field + ".joints",
           "three joints of the body, each below the one before; or -1 last, for a tip");
    if (std::ranges::find(joints, hinge.joint) != joints.end())
      fail(field + ".joints", "another joint than the hinges before");
    joints.push_back(hinge.joint);
    expect_values(hinge.axis, 3, 1, field + ".axis");
    if (!(std::abs(hinge.axis.norm() - 1) < 1e-6)) fail(field + ".axis", "a unit vector");
    expect_within(hinge.least, -std::numbers::pi, std::numbers::pi, field + ".least");
    expect_within(hinge.most, hinge.least, std::numbers::pi, field + ".most");
  }
}

void check_body(const Body& body, const Model& model) {
  check_joints(body);
  const auto check_side = [&](const std::vector<int>& joints, const std::vector<Stream>& streams,
                              const std::string& field) {
    expect_indices(joints, body.skeleton.size(), field);
    const auto rotations = std::ranges::count(streams, StreamKind::rotation, &Stream::kind);
    if (rotations != static_cast<std::ptrdiff_t>(joints.size()))
      fail(field, std::to_string(rotations) + " joints, one per rotation stream, found " +
                      std::to_string(joints.size()));
  };
  check_side(body.input_joints, model.inputs, "body.input_joints");
  check_side(body.output_joints, model.outputs, "body.output_joints");
  expect_within(body.heading_window, 1e-3, longest_delay, "body.heading_window");
  expect_within(body.hips_frame, 0, std::numbers::pi / 2, "body.hips_frame");
  check_hinges(body);
}

void check_play(const PlayDefaults& play) {
  if (play.decoder < DecoderKind::viterbi || play.decoder > DecoderKind::lag)
    fail("play.decoder", "viterbi, forward or lag");
  expect_within(play.lag, 0, longest_delay, "play.lag");
  expect_within(play.temper, 0, 1000, "play.temper");
  if (play.past) expect_within(*play.past, 0, longest_delay, "play.past");
  expect_within(play.future, 0, longest_delay, "play.future");
  expect_within(play.easing, 1e-3, 1e6, "play.easing");
  expect_within(play.strength, -1000, 1000, "play.strength");
  if (play.trust) expect_within(*play.trust, 1e-3, 1e6, "play.trust");
  expect_within(play.style_memory, 0, 1e6, "play.style_memory");
  expect_within(play.style_temper, 0, 1000, "play.style_temper");
  expect_within(play.usual_distance, 1e-6, 1e6, "play.usual_distance");
}

void check_training(const Training& training, const Model& model) {
  if (training.target.size() > 0) {
    expect_values(training.target, model.input.size() + model.output.size(), 1, "training.target");
    if (!(training.target.array() > 0).all()) fail("training.target", "variances above zero");
  }
  expect_within(training.placement, 0, std::numbers::pi, "training.placement");
  expect_text(training.date, "training.date");
  expect_text(training.comment, "training.comment");
  expect_texts(training.clips, "training.clips");
  expect_texts(training.subjects, "training.subjects");
  expect_text(training.regularisation_chosen_by, "training.regularisation_chosen_by");
  expect_within(training.regularisation, 0, largest_number, "training.regularisation");
  for (const double value : training.log_likelihood)
    expect_number(value, "training.log_likelihood");
  for (const double value : training.penalised_log_likelihood)
    expect_number(value, "training.penalised_log_likelihood");
  expect_within(training.validated_error, 0, largest_number, "training.validated_error");
  expect_within(training.validated_step_accuracy, 0, 1, "training.validated_step_accuracy");
  expect_within(training.validated_style_accuracy, 0, 1, "training.validated_style_accuracy");
  expect_within(training.validated_calibration_error, 0, 1, "training.validated_calibration_error");
  expect_within(training.strangers_error, 0, largest_number, "training.strangers_error");
  expect_within(training.strangers_step_accuracy, 0, 1, "training.strangers_step_accuracy");
}

}  // namespace

void check_model(const Model& model) {
  expect_text(model.name, "name");
  expect_within(model.frame_rate, slowest_frame_rate, fastest_frame_rate, "frame_rate");
  check_streams(model.inputs, model.input.values, "inputs");
  check_streams(model.outputs, model.output.values, "outputs");
  check_modelled(model.input.modelled, model.input.values, "input.modelled");
  check_modelled(model.output.modelled, model.output.values, "output.modelled");
  if (model.input.modelled.empty()) fail("input.modelled", "at least one value, found none");
  check_lags(model);
  if (!(model.input.clip > 0))
    fail("input.clip", "deviations above zero, found " + std::to_string(model.input.clip));
  check_scaling(model.input_scaling, model.input.size(), "input_scaling");
  check_scaling(model.output_scaling, model.output.size(), "output_scaling");
  expect_values(model.output_mean, model.output.values, 1, "output_mean");
  if (model.input_mean.size() > 0)
    expect_values(model.input_mean, model.input.values, 1, "input_mean");
  expect_names(model.styles, "styles");
  check_labels(model);
  if (model.body) check_body(*model.body, model);
  check_cycle_spaces(model);
  check_play(model.play);
  check_training(model.training, model);
}

}  // namespace gait
