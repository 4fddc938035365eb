// gait info: everything a model knows of itself.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "commands.h"
#include "gait/corpus/demo_model.h"
#include "gait/judge/stream_summary.h"
#include "gait/model/model_fields.h"
#include "gait/model/model_words.h"
#include "gait/names.h"
#include "json_report.h"
#include "number_words.h"
#include "option_kinds.h"
#include "space_report.h"

namespace gait::tool {

namespace {

using nlohmann::ordered_json;

constexpr double degrees = 180 / std::numbers::pi;

struct InfoOptions {
  std::string model;
  bool json = false;
};

std::vector<std::string> successors_of(const Model& model, const Label& label) {
  std::vector<std::string> names;
  for (const int successor : label.successors) names.push_back(model.labels[successor].name);
  return names;
}

void print_row(const char* what, const std::string& text) {
  std::printf("%-14s %s\n", what, text.c_str());
}

std::string number(double value) { return in_words("%.4g", value); }

// Degrees of rotations, the stream's own unit of anything else.
double told_deviation(const Stream& stream, const StreamSummary& summary) {
  return stream.kind == StreamKind::rotation ? degrees * summary.deviation : summary.deviation;
}

void print_streams(const char* what, const std::vector<Stream>& streams,
                   const std::vector<StreamSummary>& summaries, int values, int moving) {
  print_row(what, std::to_string(streams.size()) + " streams, " + std::to_string(values) +
                      " values, " + std::to_string(moving) +
                      " of them move (deviations, rotations in degrees):");
  std::vector<std::string> words;
  for (std::size_t i = 0; i < streams.size(); ++i)
    words.push_back(streams[i].name + " " + number(told_deviation(streams[i], summaries[i])));
  print_row("", joined_names(words));
}

void print_labels(const Model& model) {
  print_row("labels", std::to_string(model.labels.size()) + ", with " +
                          std::to_string(model.states()) + " states together");
  for (const Label& label : model.labels) {
    const std::string next = joined_names(successors_of(model, label));
    std::printf("  %-12s %zu states, %.3f s (deviation %.3f, from %.3f to %.3f), then %s\n",
                label.name.c_str(), label.states.size(), label.duration, label.duration_deviation,
                label.shortest, label.longest, next.empty() ? "nothing" : next.c_str());
    std::printf("  %-12s states last", "");
    for (const State& state : label.states) std::printf(" %.3f", state.duration);
    std::printf(" s\n");
  }
}

void print_play(const PlayDefaults& play) {
  std::string decoder(word_of(decoder_kind_words, play.decoder));
  if (play.decoder == DecoderKind::lag) decoder += ", " + number(play.lag) + " s late";
  if (play.decoder == DecoderKind::forward) decoder += ", tempered by " + number(play.temper);
  print_row("decoder", decoder);
  print_row("mapping", "strength " + number(play.strength) +
                           (play.trust ? ", up to " + number(*play.trust) + " usual distances off"
                                       : std::string()));
  print_row("trajectory", (play.past ? number(*play.past) + " s" : std::string("all")) +
                              " of past, " + number(play.future) + " s of future, eased by " +
                              number(play.easing));
  print_row("style scores", "remembered for " + number(play.style_memory) + " s, tempered by " +
                                number(play.style_temper));
}

void print_training(const Training& training) {
  if (!training.date.empty()) print_row("trained", training.date);
  print_row("from", std::to_string(training.clips.size()) + " clips");
  for (const std::string& clip : training.clips) print_row("", clip);
  print_row("regularisation",
            number(training.regularisation) + (training.regularisation_chosen_by.empty()
                                                   ? ""
                                                   : ", " + training.regularisation_chosen_by));
  if (!training.subjects.empty()) print_row("subjects", joined_names(training.subjects));
  if (!training.log_likelihood.empty())
    print_row("Baum-Welch", std::to_string(training.log_likelihood.size()) +
                                " rounds, log-likelihood " +
                                number(training.log_likelihood.back()));
  if (training.validated_step_accuracy <= 0 && training.strangers_step_accuracy <= 0) {
    print_row("validated", "no");
    return;
  }
  char text[160];
  const char* validated = "validated";
  if (training.strangers_step_accuracy > 0) {
    std::snprintf(text, sizeof text, "on strangers: error %.2f deg, step accuracy %.3f",
                  training.strangers_error * degrees, training.strangers_step_accuracy);
    print_row(validated, text);
    validated = "";
  }
  if (training.validated_step_accuracy <= 0) return;
  std::snprintf(text, sizeof text, "on held-out clips%s: error %.2f deg, step accuracy %.3f",
                *validated ? "" : " of known people", training.validated_error * degrees,
                training.validated_step_accuracy);
  print_row(validated, text);
  if (training.validated_style_accuracy > 0) {
    std::snprintf(text, sizeof text, "style accuracy %.3f, calibration error %.3f",
                  training.validated_style_accuracy, training.validated_calibration_error);
    print_row("", text);
  }
}

void print_hinges(const Body& body) {
  std::string text;
  for (const Hinge& hinge : body.hinges) {
    char angles[48];
    std::snprintf(angles, sizeof angles, " %.0f to %.0f", hinge.least * degrees,
                  hinge.most * degrees);
    append_name(text, body.skeleton.joints[hinge.joint].name + angles);
  }
  if (!text.empty()) print_row("bends", text + " degrees");
}

void print_text(const Model& model) {
  print_row("model", model.name);
  if (!model.training.comment.empty()) print_row("", model.training.comment);
  print_row("data", model.training.synthetic ? "SYNTHETIC: nobody walked these walks"
                                             : "captured, as far as its maker said");
  print_row("rate", number(model.frame_rate) + " frames/s");
  print_row("body", model.body ? std::to_string(model.body->skeleton.size()) + " joints"
                               : "none: its streams are plain values");
  if (model.body) print_hinges(*model.body);
  if (model.body && model.body->hips_frame > 0)
    print_row(
        "", "the hips' frame may lie " + number(model.body->hips_frame * degrees) + " degrees off");
  print_streams("inputs", model.inputs, summaries_of_inputs(model), model.input.values,
                model.input.statics());
  std::string history;
  for (const int lag : model.input.lags)
    append_name(history, number(1000 * lag / model.frame_rate));
  print_row("", history.empty() ? "each frame by itself" : "compared with " + history + " ms ago");
  if (model.input.clips()) print_row("", "clipped at " + number(model.input.clip) + " deviations");
  print_streams("outputs", model.outputs, summaries_of_outputs(model), model.output.values,
                model.output.statics());
  print_labels(model);
  print_row("styles", model.styles.empty() ? "none" : joined_names(model.styles));
  std::printf("\nPlayed, unless told otherwise:\n");
  print_play(model.play);
  print_spaces(model);
  std::printf("\n");
  print_training(model.training);
}

ordered_json as_json(const std::vector<Stream>& streams,
                     const std::vector<StreamSummary>& summaries, int values, int moving) {
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < streams.size(); ++i)
    list.push_back({{"name", streams[i].name},
                    {"size", streams[i].size},
                    {"kind", word_of(stream_kind_words, streams[i].kind)},
                    {"moving", summaries[i].moving},
                    {"deviation", told_deviation(streams[i], summaries[i])}});
  return {{"streams", list}, {"values", values}, {"values_moving", moving}};
}

// Lists play settings; those that the model has none of are null.
struct SettingsList {
  void operator()(const char* key, double value) { settings[key] = value; }
  void operator()(const char* key, DecoderKind value) {
    settings[key] = word_of(decoder_kind_words, value);
  }
  void optional(const char* key, double value, bool) { settings[key] = value; }
  void optional(const char* key, const std::optional<double>& value, bool is_set) {
    settings[key] = is_set ? ordered_json(*value) : ordered_json();
  }
  ordered_json settings;
};

ordered_json as_json(const PlayDefaults& play) {
  SettingsList list;
  fields_of(list, play);
  return list.settings;
}

ordered_json as_json(const Training& training) {
  ordered_json validated = nullptr;
  if (training.validated_step_accuracy > 0)
    validated = {{"output_error_deg", training.validated_error * degrees},
                 {"step_accuracy", training.validated_step_accuracy},
                 {"style_accuracy", training.validated_style_accuracy},
                 {"calibration_error", training.validated_calibration_error}};
  if (training.strangers_step_accuracy > 0)
    validated["strangers"] = {{"output_error_deg", training.strangers_error * degrees},
                              {"step_accuracy", training.strangers_step_accuracy}};
  return {{"date", training.date},
          {"clips", training.clips},
          {"subjects", training.subjects},
          {"regularisation", training.regularisation},
          {"regularisation_chosen_by", training.regularisation_chosen_by},
          {"log_likelihood", training.log_likelihood},
          {"penalised_log_likelihood", training.penalised_log_likelihood},
          {"validated", validated}};
}

void print_json(const Model& model) {
  ordered_json labels = ordered_json::array(), lags = ordered_json::array();
  for (const Label& label : model.labels) {
    ordered_json states = ordered_json::array();
    for (const State& state : label.states)
      states.push_back({{"seconds", state.duration}, {"weight", state.weight}});
    labels.push_back({{"name", label.name},
                      {"successors", successors_of(model, label)},
                      {"states", states},
                      {"seconds", label.duration},
                      {"seconds_deviation", label.duration_deviation},
                      {"seconds_shortest", label.shortest},
                      {"seconds_longest", label.longest}});
  }
  for (const int lag : model.input.lags) lags.push_back(1000 * lag / model.frame_rate);
  ordered_json joints = nullptr, hinges = nullptr;
  if (model.body) {
    joints = ordered_json::array(), hinges = ordered_json::array();
    for (int joint = 0; joint < model.body->skeleton.size(); ++joint)
      joints.push_back({{"name", model.body->skeleton.joints[joint].name},
                        {"role", role_name(model.body->roles[joint])}});
    for (const Hinge& hinge : model.body->hinges)
      hinges.push_back({{"joint", model.body->skeleton.joints[hinge.joint].name},
                        {"least_degrees", hinge.least * degrees},
                        {"most_degrees", hinge.most * degrees}});
  }
  const ordered_json report{
      {"name", model.name},
      {"comment", model.training.comment},
      {"synthetic", model.training.synthetic},
      {"frame_rate", model.frame_rate},
      {"joints", joints},
      {"hinges", hinges},
      {"inputs", as_json(model.inputs, summaries_of_inputs(model), model.input.values,
                         model.input.statics())},
      {"history_ms", lags},
      {"clip", model.input.clips() ? ordered_json(model.input.clip) : ordered_json()},
      {"hips_frame_degrees",
       model.body ? ordered_json(model.body->hips_frame * degrees) : ordered_json()},
      {"outputs", as_json(model.outputs, summaries_of_outputs(model), model.output.values,
                          model.output.statics())},
      {"labels", labels},
      {"styles", model.styles},
      {"play", as_json(model.play)},
      {"spaces", spaces_as_json(model)},
      {"training", as_json(model.training)}};
  print_report(report);
}

void info(const InfoOptions& options) {
  const Model model = model_named(options.model);
  if (options.json)
    print_json(model);
  else
    print_text(model);
}

void add_options(CLI::App& app, InfoOptions& options) {
  add_model_argument(app, options.model);
  add_json_flag(app, options.json);
  app.footer(R"(Durations are in seconds, angles in degrees.

Examples:
  gait info walks.gait
  gait info gait-demo --json)");
}

}  // namespace

Command info_command(CLI::App& program) {
  return make_command(program, "info", "Say what is in a model", add_options, info);
}

}  // namespace gait::tool
