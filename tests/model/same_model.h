// Whether two models are the same to the bit. The structured bindings name every field: a field
// that is added to the model without a place in its file does not compile here.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <type_traits>
#include <vector>

#include "gait/model/model.h"

namespace gait::testing {

template <typename Value>
requires std::is_integral_v<Value> || std::is_enum_v<Value>
void expect_same(Value a, Value b) { EXPECT_EQ(a, b); }

inline void expect_same(double a, double b) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)) << a << ", " << b;
}

inline void expect_same(const std::optional<double>& a, const std::optional<double>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) expect_same(*a, *b);
}

inline void expect_same(const std::string& a, const std::string& b) { EXPECT_EQ(a, b); }

template <typename Derived>
void expect_same(const Eigen::PlainObjectBase<Derived>& a,
                 const Eigen::PlainObjectBase<Derived>& b) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.cols(), b.cols());
  for (Eigen::Index i = 0; i < a.size(); ++i) expect_same(a.data()[i], b.data()[i]);
}

inline void expect_same(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  expect_same(a.coeffs(), b.coeffs());
}

inline void expect_same(const Stream& a, const Stream& b) {
  const auto& [name, size, kind] = a;
  EXPECT_EQ(name, b.name);
  EXPECT_EQ(size, b.size);
  EXPECT_EQ(kind, b.kind);
}

inline void expect_same(const Joint& a, const Joint& b);
inline void expect_same(const Hinge& a, const Hinge& b);
inline void expect_same(const State& a, const State& b);
inline void expect_same(const Label& a, const Label& b);
inline void expect_same(const Variation& a, const Variation& b);
inline void expect_same(const StyleCycles& a, const StyleCycles& b);
inline void expect_same(const SpeedSpace& a, const SpeedSpace& b);

template <typename Value>
void expect_same(const std::vector<Value>& a, const std::vector<Value>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) expect_same(a[i], b[i]);
}

inline void expect_same(const Joint& a, const Joint& b) {
  // Where a turned-over joint sits told its role, which the file keeps.
  const auto& [name, parent, offset, tips, sits_at] = a;
  expect_same(name, b.name);
  expect_same(parent, b.parent);
  expect_same(offset, b.offset);
  expect_same(tips, b.tips);
}

inline void expect_same(const State& a, const State& b) {
  const auto& [mean, covariance, stay, duration, weight, style_means, style_covariance,
               trajectory_means, trajectory_variances] = a;
  expect_same(mean, b.mean);
  expect_same(covariance, b.covariance);
  expect_same(stay, b.stay);
  expect_same(duration, b.duration);
  expect_same(weight, b.weight);
  expect_same(style_means, b.style_means);
  expect_same(style_covariance, b.style_covariance);
  expect_same(trajectory_means, b.trajectory_means);
  expect_same(trajectory_variances, b.trajectory_variances);
}

inline void expect_same(const Label& a, const Label& b) {
  const auto& [name, successors, states, duration, deviation, shortest, longest, style_durations] =
      a;
  expect_same(name, b.name);
  expect_same(successors, b.successors);
  expect_same(states, b.states);
  expect_same(duration, b.duration);
  expect_same(deviation, b.duration_deviation);
  expect_same(shortest, b.shortest);
  expect_same(longest, b.longest);
  expect_same(style_durations, b.style_durations);
}

inline void expect_same(const Hinge& a, const Hinge& b) {
  const auto& [above, joint, below, axis, least, most] = a;
  expect_same(above, b.above);
  expect_same(joint, b.joint);
  expect_same(below, b.below);
  expect_same(axis, b.axis);
  expect_same(least, b.least);
  expect_same(most, b.most);
}

inline void expect_same(const Body& a, const Body& b) {
  const auto& [skeleton, roles, references, input_joints, output_joints, heading_window, hinges] =
      a;
  expect_same(skeleton.joints, b.skeleton.joints);
  expect_same(roles, b.roles);
  expect_same(references, b.references);
  expect_same(input_joints, b.input_joints);
  expect_same(output_joints, b.output_joints);
  expect_same(heading_window, b.heading_window);
  expect_same(hinges, b.hinges);
}

inline void expect_same(const PlayDefaults& a, const PlayDefaults& b) {
  const auto& [decoder, lag, temper, past, future, strength, style_memory, style_temper,
               usual_distance] = a;
  expect_same(decoder, b.decoder);
  expect_same(lag, b.lag);
  expect_same(temper, b.temper);
  expect_same(past, b.past);
  expect_same(future, b.future);
  expect_same(strength, b.strength);
  expect_same(style_memory, b.style_memory);
  expect_same(style_temper, b.style_temper);
  expect_same(usual_distance, b.usual_distance);
}

inline void expect_same(const Training& a, const Training& b) {
  const auto& [date, comment, clips, regularisation, chosen_by, likelihood, penalised, error,
               step_accuracy, style_accuracy, calibration_error, synthetic] = a;
  expect_same(date, b.date);
  expect_same(comment, b.comment);
  expect_same(clips, b.clips);
  expect_same(regularisation, b.regularisation);
  expect_same(chosen_by, b.regularisation_chosen_by);
  expect_same(likelihood, b.log_likelihood);
  expect_same(penalised, b.penalised_log_likelihood);
  expect_same(error, b.validated_error);
  expect_same(step_accuracy, b.validated_step_accuracy);
  expect_same(style_accuracy, b.validated_style_accuracy);
  expect_same(calibration_error, b.validated_calibration_error);
  expect_same(synthetic, b.synthetic);
}

inline void expect_same(const Scaling& a, const Scaling& b) {
  const auto& [mean, deviation] = a;
  expect_same(mean, b.mean);
  expect_same(deviation, b.deviation);
}

inline void expect_same(const CycleSpace& a, const CycleSpace& b) {
  const auto& [frames, joints, mean, components, variances] = a;
  expect_same(frames, b.frames);
  expect_same(joints, b.joints);
  expect_same(mean, b.mean);
  expect_same(components, b.components);
  expect_same(variances, b.variances);
}

inline void expect_same(const Variation& a, const Variation& b) {
  const auto& [mean, deviation, largest_change, lowest, highest] = a;
  expect_same(mean, b.mean);
  expect_same(deviation, b.deviation);
  expect_same(largest_change, b.largest_change);
  expect_same(lowest, b.lowest);
  expect_same(highest, b.highest);
}

inline void expect_same(const StyleCycles& a, const StyleCycles& b) {
  const auto& [cycles, scores, duration, correlation, projected, durations] = a;
  expect_same(cycles, b.cycles);
  expect_same(scores, b.scores);
  expect_same(duration, b.duration);
  expect_same(correlation, b.correlation);
  expect_same(projected, b.projected);
  expect_same(durations, b.durations);
}

inline void expect_same(const StyleSpace& a, const StyleSpace& b) {
  const auto& [space, cycles_per_style, styles] = a;
  expect_same(space, b.space);
  expect_same(cycles_per_style, b.cycles_per_style);
  expect_same(styles, b.styles);
}

inline void expect_same(const SpeedSpace& a, const SpeedSpace& b) {
  const auto& [subject, leg_length, space, cycles, intercept, slope, standing, slowest, fastest,
               speeds, frequencies, projected, frequency_scale, frequency_power, shared] = a;
  expect_same(subject, b.subject);
  expect_same(leg_length, b.leg_length);
  expect_same(space, b.space);
  expect_same(cycles, b.cycles);
  expect_same(intercept, b.intercept);
  expect_same(slope, b.slope);
  expect_same(standing, b.standing);
  expect_same(slowest, b.slowest);
  expect_same(fastest, b.fastest);
  expect_same(speeds, b.speeds);
  expect_same(frequencies, b.frequencies);
  expect_same(projected, b.projected);
  expect_same(frequency_scale, b.frequency_scale);
  expect_same(frequency_power, b.frequency_power);
  const auto& [shared_intercept, shared_slope, shared_standing, shared_projected] = shared;
  expect_same(shared_intercept, b.shared.intercept);
  expect_same(shared_slope, b.shared.slope);
  expect_same(shared_standing, b.shared.standing);
  expect_same(shared_projected, b.shared.projected);
}

inline void expect_same(const Model& a, const Model& b) {
  const auto& [name, frame_rate, inputs, outputs, input, output, input_scaling, output_scaling,
               output_mean, input_mean, labels, styles, body, style_space, speed_spaces,
               shared_speed_space, play, training] = a;
  expect_same(name, b.name);
  expect_same(frame_rate, b.frame_rate);
  expect_same(inputs, b.inputs);
  expect_same(outputs, b.outputs);
  const auto& [input_values, input_modelled, lags] = input;
  expect_same(input_values, b.input.values);
  expect_same(input_modelled, b.input.modelled);
  expect_same(lags, b.input.lags);
  const auto& [output_values, output_modelled] = output;
  expect_same(output_values, b.output.values);
  expect_same(output_modelled, b.output.modelled);
  expect_same(input_scaling, b.input_scaling);
  expect_same(output_scaling, b.output_scaling);
  expect_same(output_mean, b.output_mean);
  expect_same(input_mean, b.input_mean);
  expect_same(labels, b.labels);
  expect_same(styles, b.styles);
  ASSERT_EQ(body.has_value(), b.body.has_value());
  if (body) expect_same(*body, *b.body);
  ASSERT_EQ(style_space.has_value(), b.style_space.has_value());
  if (style_space) expect_same(*style_space, *b.style_space);
  expect_same(speed_spaces, b.speed_spaces);
  ASSERT_EQ(shared_speed_space.has_value(), b.shared_speed_space.has_value());
  if (shared_speed_space) expect_same(*shared_speed_space, *b.shared_speed_space);
  expect_same(play, b.play);
  expect_same(training, b.training);
}

}  // namespace gait::testing
