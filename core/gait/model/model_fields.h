// The fields of a model file (docs/model-file.md), each named once for reading and for writing.
//
// `fields_of(file, part)` calls `file(key, value)` for each field of a part of a model. `file` is
// the FieldReader of model_read.cpp, which sets the values, or the FieldWriter of model_write.cpp,
// which keeps them; `gait info` lists the play settings with one of its own. Their other functions:
//   file.symmetric(key, matrix)            keeps the lower triangle of a symmetric matrix
//   file.optional(key, value, is_written)  reads the field where it is there
//   file.frame_rate, file.lags, file.joints
// Fields are read in the order they stand in here: the first that is wrong is the one that is
// named.
#pragma once

#include <concepts>
#include <type_traits>

#include "gait/model/model.h"

namespace gait {

// `Part` that is read (not const) or written (const).
template <typename T, typename Part>
concept PartOf = std::same_as<std::remove_const_t<T>, Part>;

void fields_of(auto& file, PartOf<Stream> auto& stream) {
  file("name", stream.name);
  file("size", stream.size);
  file("kind", stream.kind);
}

void fields_of(auto& file, PartOf<InputLayout> auto& layout, double frame_rate) {
  file("values", layout.values);
  file("modelled", layout.modelled);
  file.lags("history", layout.lags, frame_rate);
  file.optional("clip", layout.clip, layout.clips());
}

void fields_of(auto& file, PartOf<OutputLayout> auto& layout) {
  file("values", layout.values);
  file("modelled", layout.modelled);
}

void fields_of(auto& file, PartOf<Scaling> auto& scaling) {
  file("mean", scaling.mean);
  file("deviation", scaling.deviation);
}

// What a model has besides its Gaussians decides which fields its labels and states have.
struct LabelContents {
  bool styles = false;        // the model has styles
  bool trajectories = false;  // it can walk without input
};

void fields_of(auto& file, PartOf<State> auto& state, const LabelContents& contents) {
  file("mean", state.mean);
  file.symmetric("covariance", state.covariance);
  file("stay", state.stay);
  file("duration", state.duration);
  file("weight", state.weight);
  file.optional("phase_covariance", state.phase_covariance, state.phase_covariance.size() > 0);
  if (state.phase_covariance.size() > 0) file("phase", state.phase);
  if (contents.trajectories) {
    file("trajectory_means", state.trajectory_means);
    file("trajectory_variances", state.trajectory_variances);
  }
  if (contents.styles) {
    file("style_means", state.style_means);
    file.symmetric("style_covariance", state.style_covariance);
  }
}

void fields_of(auto& file, PartOf<Label> auto& label, const LabelContents& contents) {
  file("name", label.name);
  file("successors", label.successors);
  file("duration", label.duration);
  file("duration_deviation", label.duration_deviation);
  file("shortest", label.shortest);
  file("longest", label.longest);
  if (contents.styles && contents.trajectories) file("style_durations", label.style_durations);
  file("states", label.states, contents);
}

// A joint with what a body holds beside its skeleton.
struct BodyJoint {
  Joint joint;
  Role role = Role::none;
  Eigen::Quaterniond reference = Eigen::Quaterniond::Identity();
};

void fields_of(auto& file, PartOf<BodyJoint> auto& item) {
  file("name", item.joint.name);
  file("parent", item.joint.parent);
  file("offset", item.joint.offset);
  file("tips", item.joint.tips);
  file("role", item.role);
  file("reference", item.reference);
}

void fields_of(auto& file, PartOf<Hinge> auto& hinge) {
  file.joints("joints", hinge);
  file("axis", hinge.axis);
  file("least", hinge.least);
  file("most", hinge.most);
}

void fields_of(auto& file, PartOf<Body> auto& body) {
  file.joints("joints", body);
  file("input_joints", body.input_joints);
  file("output_joints", body.output_joints);
  file("heading_window", body.heading_window);
  file.optional("hips_frame", body.hips_frame, body.hips_frame > 0);
  file.optional("hinges", body.hinges, true);
}

void fields_of(auto& file, PartOf<CycleSpace> auto& space) {
  file("frames", space.frames);
  file("joints", space.joints);
  file("mean", space.mean);
  file("components", space.components);
  file("variances", space.variances);
}

void fields_of(auto& file, PartOf<Variation> auto& variation) {
  file("mean", variation.mean);
  file("deviation", variation.deviation);
  file("largest_change", variation.largest_change);
  file("lowest", variation.lowest);
  file("highest", variation.highest);
}

void fields_of(auto& file, PartOf<StyleCycles> auto& style) {
  file("cycles", style.cycles);
  file("scores", style.scores);
  file("duration", style.duration);
  file.symmetric("correlation", style.correlation);
  file("projected", style.projected);
  file("durations", style.durations);
}

void fields_of(auto& file, PartOf<StyleSpace> auto& space) {
  file("space", space.space);
  file("cycles_per_style", space.cycles_per_style);
  file("styles", space.styles);
}

void fields_of(auto& file, PartOf<SharedLines> auto& lines) {
  file("intercept", lines.intercept);
  file("slope", lines.slope);
  file("standing", lines.standing);
  file("projected", lines.projected);
}

void fields_of(auto& file, PartOf<SpeedSpace> auto& space) {
  file("subject", space.subject);
  file("leg_length", space.leg_length);
  file("space", space.space);
  file("cycles", space.cycles);
  file("intercept", space.intercept);
  file("slope", space.slope);
  file("standing", space.standing);
  file("slowest", space.slowest);
  file("fastest", space.fastest);
  file("speeds", space.speeds);
  file("frequencies", space.frequencies);
  file("projected", space.projected);
  file("frequency_scale", space.frequency_scale);
  file("frequency_power", space.frequency_power);
  file.optional("shared", space.shared, space.shared.intercept.size() > 0);
}

void fields_of(auto& file, PartOf<PlayDefaults> auto& play) {
  file("decoder", play.decoder);
  file("lag", play.lag);
  file("temper", play.temper);
  file.optional("past", play.past, play.past.has_value());
  file("future", play.future);
  file.optional("easing", play.easing, play.easing != 1);
  file("strength", play.strength);
  file.optional("trust", play.trust, play.trust.has_value());
  file("style_memory", play.style_memory);
  file("style_temper", play.style_temper);
  file("usual_distance", play.usual_distance);
}

void fields_of(auto& file, PartOf<Training> auto& training) {
  file("date", training.date);
  file("comment", training.comment);
  file("clips", training.clips);
  file.optional("subjects", training.subjects, !training.subjects.empty());
  file("regularisation", training.regularisation);
  file("regularisation_chosen_by", training.regularisation_chosen_by);
  file.optional("target", training.target, training.target.size() > 0);
  file.optional("placement", training.placement, training.placement > 0);
  file("log_likelihood", training.log_likelihood);
  file("penalised_log_likelihood", training.penalised_log_likelihood);
  file("validated_error", training.validated_error);
  file("validated_step_accuracy", training.validated_step_accuracy);
  file("validated_style_accuracy", training.validated_style_accuracy);
  file("validated_calibration_error", training.validated_calibration_error);
  file.optional("strangers_error", training.strangers_error, training.strangers_error > 0);
  file.optional("strangers_step_accuracy", training.strangers_step_accuracy,
                training.strangers_step_accuracy > 0);
  file("synthetic", training.synthetic);
}

void fields_of(auto& file, PartOf<Model> auto& model) {
  file("name", model.name);
  file.frame_rate("frame_rate", model.frame_rate);
  file("inputs", model.inputs);
  file("outputs", model.outputs);
  file("input", model.input, model.frame_rate);
  file("output", model.output);
  file("input_scaling", model.input_scaling);
  file("output_scaling", model.output_scaling);
  file("output_mean", model.output_mean);
  file.optional("input_mean", model.input_mean, model.input_mean.size() > 0);
  file("styles", model.styles);
  file("labels", model.labels, LabelContents{!model.styles.empty(), model.input_mean.size() > 0});
  file.optional("body", model.body, model.body.has_value());
  file.optional("style_space", model.style_space, model.style_space.has_value());
  file.optional("speed_spaces", model.speed_spaces, !model.speed_spaces.empty());
  file.optional("shared_speed_space", model.shared_speed_space,
                model.shared_speed_space.has_value());
  file("play", model.play);
  file("training", model.training);
}

}  // namespace gait
