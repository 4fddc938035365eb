#include <cmath>
#include <fstream>

#include "gait/error.h"
#include "gait/model/cycle_space_fields.h"
#include "gait/model/model_field.h"
#include "gait/model/model_file.h"
#include "gait/model/model_words.h"

namespace gait {

namespace {

// Models are some megabytes; whoever names a film by mistake need not wait for it.
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;

template <typename Words>
auto kind_of(const Words& words, const ModelField& field) {
  std::string known;
  for (const auto& [kind, word] : words) {
    if (field.text() == word) return kind;
    known += (known.empty() ? "" : ", ") + std::string(word);
  }
  field.fail("one of " + known + ", found '" + field.text() + "'");
}

void expect_format(const ModelField& document) {
  if (const auto format = document.find("format"); !format || format->text() != model_file_format)
    document.fail("a gait model; the format is another");
  const ModelField version = document["version"];
  if (version.integer() < 1) version.fail("1 or more, found " + std::to_string(version.integer()));
  if (version.integer() > model_file_version)
    version.fail("at most " + std::to_string(model_file_version) + ", found " +
                 std::to_string(version.integer()) + ": the model was made by a newer gait");
}

std::vector<Stream> streams(const ModelField& field) {
  std::vector<Stream> streams;
  for (const ModelField& item : field.items())
    streams.push_back(
        {item["name"].text(), item["size"].integer(), kind_of(stream_kind_words, item["kind"])});
  return streams;
}

// Looked at before everything else: frames from seconds mean nothing without it.
double frame_rate(const ModelField& field) {
  const double rate = field.number();
  if (rate < slowest_frame_rate || rate > fastest_frame_rate)
    field.fail("1 to 1000 frames per second, found " + std::to_string(rate));
  return rate;
}

// Seconds back to frames back; they are whole up to rounding.
std::vector<int> lags(const ModelField& history, double frame_rate) {
  std::vector<int> lags;
  for (const ModelField& item : history.items()) {
    const double frames = item.number() * frame_rate;
    if (!(frames > 0.5 && frames < 1e6) || std::abs(frames - std::round(frames)) > 1e-6)
      item.fail("a time of whole frames, found " + std::to_string(frames));
    lags.push_back(static_cast<int>(std::lround(frames)));
  }
  return lags;
}

Scaling scaling(const ModelField& field) {
  return {field["mean"].vector(), field["deviation"].vector()};
}

// `walks`: with what walks without input need.
State state(const ModelField& field, bool styles, bool walks) {
  State state;
  state.mean = field["mean"].vector();
  state.covariance = field["covariance"].symmetric();
  state.stay = field["stay"].number();
  state.duration = field["duration"].number();
  state.weight = field["weight"].number();
  if (walks) {
    state.trajectory_means = field["trajectory_means"].matrix();
    state.trajectory_variances = field["trajectory_variances"].vector();
  }
  if (styles) {
    state.style_means = field["style_means"].matrix();
    state.style_covariance = field["style_covariance"].symmetric();
  }
  return state;
}

Label label(const ModelField& field, bool styles, bool walks) {
  Label label;
  label.name = field["name"].text();
  label.successors = field["successors"].integers();
  label.duration = field["duration"].number();
  label.duration_deviation = field["duration_deviation"].number();
  label.shortest = field["shortest"].number();
  label.longest = field["longest"].number();
  if (styles && walks) label.style_durations = field["style_durations"].vector();
  for (const ModelField& item : field["states"].items())
    label.states.push_back(state(item, styles, walks));
  return label;
}

std::vector<double> values(const ModelField& field, std::size_t count) {
  std::vector<double> values = field.numbers();
  if (values.size() != count)
    field.fail(std::to_string(count) + " numbers, found " + std::to_string(values.size()));
  return values;
}

Eigen::Vector3d point(const ModelField& field) {
  const std::vector<double> xyz = values(field, 3);
  return {xyz[0], xyz[1], xyz[2]};
}

Body body(const ModelField& field) {
  Body body;
  for (const ModelField& item : field["joints"].items()) {
    Joint joint{item["name"].text(), item["parent"].integer(), point(item["offset"]), {}};
    for (const ModelField& tip : item["tips"].items()) joint.tips.push_back(point(tip));
    body.skeleton.joints.push_back(std::move(joint));
    const ModelField role = item["role"];
    const auto known = role_from_name(role.text());
    if (!known) role.fail("a joint's role, found '" + role.text() + "'");
    body.roles.push_back(*known);
    const std::vector<double> wxyz = values(item["reference"], 4);
    body.references.emplace_back(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  }
  body.input_joints = field["input_joints"].integers();
  body.output_joints = field["output_joints"].integers();
  body.heading_window = field["heading_window"].number();
  if (const auto hinges = field.find("hinges"))
    for (const ModelField& item : hinges->items()) {
      const ModelField joints = item["joints"];
      const std::vector<int> indices = joints.integers();
      if (indices.size() != 3) joints.fail("3 joints, found " + std::to_string(indices.size()));
      body.hinges.push_back({indices[0], indices[1], indices[2], point(item["axis"]),
                             item["least"].number(), item["most"].number()});
    }
  return body;
}

PlayDefaults play(const ModelField& field) {
  return {.decoder = kind_of(decoder_kind_words, field["decoder"]),
          .lag = field["lag"].number(),
          .temper = field["temper"].number(),
          .past = field["past"].number(),
          .future = field["future"].number(),
          .strength = field["strength"].number(),
          .style_memory = field["style_memory"].number(),
          .style_temper = field["style_temper"].number(),
          .usual_distance = field["usual_distance"].number()};
}

Training training(const ModelField& field) {
  return {.date = field["date"].text(),
          .comment = field["comment"].text(),
          .clips = field["clips"].texts(),
          .regularisation = field["regularisation"].number(),
          .regularisation_chosen_by = field["regularisation_chosen_by"].text(),
          .log_likelihood = field["log_likelihood"].numbers(),
          .penalised_log_likelihood = field["penalised_log_likelihood"].numbers(),
          .validated_error = field["validated_error"].number(),
          .validated_step_accuracy = field["validated_step_accuracy"].number(),
          .validated_style_accuracy = field["validated_style_accuracy"].number(),
          .validated_calibration_error = field["validated_calibration_error"].number(),
          .synthetic = field["synthetic"].truth()};
}

Model model_of(const ModelField& document) {
  expect_format(document);
  Model model;
  model.name = document["name"].text();
  model.frame_rate = frame_rate(document["frame_rate"]);
  model.inputs = streams(document["inputs"]);
  model.outputs = streams(document["outputs"]);
  const ModelField input = document["input"], output = document["output"];
  model.input = {input["values"].integer(), input["modelled"].integers(),
                 lags(input["history"], model.frame_rate)};
  model.output = {output["values"].integer(), output["modelled"].integers()};
  model.input_scaling = scaling(document["input_scaling"]);
  model.output_scaling = scaling(document["output_scaling"]);
  model.output_mean = document["output_mean"].vector();
  if (const auto field = document.find("input_mean")) model.input_mean = field->vector();
  model.styles = document["styles"].texts();
  for (const ModelField& item : document["labels"].items())
    model.labels.push_back(label(item, !model.styles.empty(), model.input_mean.size() > 0));
  if (const auto field = document.find("body")) model.body = body(*field);
  if (const auto field = document.find("style_space")) model.style_space = style_space(*field);
  if (const auto field = document.find("speed_spaces"))
    for (const ModelField& item : field->items()) model.speed_spaces.push_back(speed_space(item));
  if (const auto field = document.find("shared_speed_space"))
    model.shared_speed_space = cycle_space(*field);
  model.play = play(document["play"]);
  model.training = training(document["training"]);
  return model;
}

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size =
      std::filesystem::is_regular_file(path, error) ? std::filesystem::file_size(path, error) : 0;
  if (error || !std::filesystem::is_regular_file(path, error))
    throw Error(path.string() + ": expected a model file" +
                (error ? ": " + error.message() : ", found something else"));
  if (size > largest_file)
    throw Error(path.string() + ": expected a model file of at most 1 GB, found " +
                std::to_string(size / (1 << 20)) + " MB");
  std::vector<std::uint8_t> bytes(size);
  std::ifstream stream(path, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream) throw Error(path.string() + ": cannot be read");
  return bytes;
}

}  // namespace

Model parse_model(std::span<const std::uint8_t> bytes, const std::string& name) {
  try {
    const CborDocument document = read_cbor(bytes);
    Model model = model_of(ModelField(document));
    check_model(model);
    return model;
  } catch (const Error& error) {
    throw Error(name + ": " + error.what());
  }
}

Model read_model(const std::filesystem::path& path) {
  return parse_model(bytes_of(path), path.string());
}

}  // namespace gait
