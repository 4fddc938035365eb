#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "gait/error.h"
#include "gait/model/array_node.h"
#include "gait/model/cycle_space_fields.h"
#include "gait/model/model_field.h"
#include "gait/model/model_file.h"
#include "gait/model/model_words.h"

namespace gait {

namespace {

using Json = nlohmann::json;

template <typename Words, typename Kind>
std::string word_of(const Words& words, Kind kind) {
  for (const auto& [known, word] : words)
    if (known == kind) return std::string(word);
  throw Error("expected a known kind");  // check_model has seen to it
}

Json node(const Scaling& scaling) {
  return {{"mean", array_node(scaling.mean)}, {"deviation", array_node(scaling.deviation)}};
}

Json node(const std::vector<Stream>& streams) {
  Json list = Json::array();
  for (const Stream& stream : streams)
    list.push_back({{"name", stream.name},
                    {"size", stream.size},
                    {"kind", word_of(stream_kind_words, stream.kind)}});
  return list;
}

// Differences reach back in time, so that the file does not depend on the frame rate.
Json node(const InputLayout& layout, double frame_rate) {
  std::vector<double> history;
  for (const int lag : layout.lags) history.push_back(lag / frame_rate);
  return {{"values", layout.values}, {"modelled", layout.modelled}, {"history", history}};
}

// `walks`: with what walks without input need.
Json node(const State& state, bool styles, bool walks) {
  Json node_of_state = {{"mean", array_node(state.mean)},
                        {"covariance", symmetric_array_node(state.covariance)},
                        {"stay", state.stay},
                        {"duration", state.duration},
                        {"weight", state.weight}};
  if (walks) {
    node_of_state["trajectory_means"] = array_node(state.trajectory_means);
    node_of_state["trajectory_variances"] = array_node(state.trajectory_variances);
  }
  if (styles) {
    node_of_state["style_means"] = array_node(state.style_means);
    node_of_state["style_covariance"] = symmetric_array_node(state.style_covariance);
  }
  return node_of_state;
}

Json node(const Label& label, bool styles, bool walks) {
  Json states = Json::array();
  for (const State& state : label.states) states.push_back(node(state, styles, walks));
  Json node_of_label = {
      {"name", label.name},         {"successors", label.successors},
      {"duration", label.duration}, {"duration_deviation", label.duration_deviation},
      {"shortest", label.shortest}, {"longest", label.longest},
      {"states", std::move(states)}};
  if (styles && walks) node_of_label["style_durations"] = array_node(label.style_durations);
  return node_of_label;
}

Json triple(const Eigen::Vector3d& point) { return {point.x(), point.y(), point.z()}; }

Json node(const Body& body) {
  Json joints = Json::array();
  for (std::size_t i = 0; i < body.skeleton.joints.size(); ++i) {
    const Joint& joint = body.skeleton.joints[i];
    const Eigen::Quaterniond& reference = body.references[i];
    Json tips = Json::array();
    for (const Eigen::Vector3d& tip : joint.tips) tips.push_back(triple(tip));
    joints.push_back({{"name", joint.name},
                      {"parent", joint.parent},
                      {"offset", triple(joint.offset)},
                      {"tips", std::move(tips)},
                      {"role", role_name(body.roles[i])},
                      {"reference", {reference.w(), reference.x(), reference.y(), reference.z()}}});
  }
  Json hinges = Json::array();
  for (const Hinge& hinge : body.hinges)
    hinges.push_back({{"joints", {hinge.above, hinge.joint, hinge.below}},
                      {"axis", triple(hinge.axis)},
                      {"least", hinge.least},
                      {"most", hinge.most}});
  return {{"joints", std::move(joints)},
          {"input_joints", body.input_joints},
          {"output_joints", body.output_joints},
          {"heading_window", body.heading_window},
          {"hinges", std::move(hinges)}};
}

Json node(const PlayDefaults& play) {
  return {{"decoder", word_of(decoder_kind_words, play.decoder)},
          {"lag", play.lag},
          {"temper", play.temper},
          {"past", play.past},
          {"future", play.future},
          {"strength", play.strength},
          {"style_memory", play.style_memory},
          {"style_temper", play.style_temper},
          {"usual_distance", play.usual_distance}};
}

Json node(const Training& training) {
  return {{"date", training.date},
          {"comment", training.comment},
          {"clips", training.clips},
          {"regularisation", training.regularisation},
          {"regularisation_chosen_by", training.regularisation_chosen_by},
          {"log_likelihood", training.log_likelihood},
          {"penalised_log_likelihood", training.penalised_log_likelihood},
          {"validated_error", training.validated_error},
          {"validated_step_accuracy", training.validated_step_accuracy},
          {"validated_style_accuracy", training.validated_style_accuracy},
          {"validated_calibration_error", training.validated_calibration_error},
          {"synthetic", training.synthetic}};
}

Json node(const Model& model) {
  Json labels = Json::array();
  for (const Label& label : model.labels)
    labels.push_back(node(label, !model.styles.empty(), model.input_mean.size() > 0));
  Json document = {
      {"format", model_file_format},
      {"version", model_file_version},
      {"name", model.name},
      {"frame_rate", model.frame_rate},
      {"inputs", node(model.inputs)},
      {"outputs", node(model.outputs)},
      {"input", node(model.input, model.frame_rate)},
      {"output", {{"values", model.output.values}, {"modelled", model.output.modelled}}},
      {"input_scaling", node(model.input_scaling)},
      {"output_scaling", node(model.output_scaling)},
      {"output_mean", array_node(model.output_mean)},
      {"styles", model.styles},
      {"labels", std::move(labels)},
      {"play", node(model.play)},
      {"training", node(model.training)}};
  if (model.input_mean.size() > 0) document["input_mean"] = array_node(model.input_mean);
  if (model.body) document["body"] = node(*model.body);
  if (model.style_space) document["style_space"] = field_of(*model.style_space);
  for (const SpeedSpace& space : model.speed_spaces)
    document["speed_spaces"].push_back(field_of(space));
  if (model.shared_speed_space)
    document["shared_speed_space"] = field_of(*model.shared_speed_space);
  return document;
}

}  // namespace

std::vector<std::uint8_t> model_bytes(const Model& model) {
  check_model(model);
  return Json::to_cbor(node(model));
}

void write_model(const Model& model, const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = model_bytes(model);
  std::filesystem::path unfinished = path;
  unfinished += ".part";
  std::error_code error, ignored;
  std::ofstream stream(unfinished, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (stream) std::filesystem::rename(unfinished, path, error);
  if (!stream || error) {
    std::filesystem::remove(unfinished, ignored);
    throw Error(path.string() + ": cannot be written" + (error ? ": " + error.message() : ""));
  }
}

}  // namespace gait
