#include "train_report.h"

#include <cstdio>
#include <map>
#include <numbers>

#include "gait/names.h"
#include "gait/platform/path_text.h"
#include "json_report.h"

namespace gait::tool {

namespace {

using nlohmann::ordered_json;

constexpr double degrees = 180 / std::numbers::pi;

std::string joined(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + ", " + b;
}

std::map<std::string, int> clips_of_styles(const WalkSequences& walks) {
  std::map<std::string, int> clips;
  for (const WalkUse& use : walks.uses)
    if (use.used && !use.style.empty()) ++clips[use.style];
  return clips;
}

// What a user should know though nothing failed.
std::vector<std::string> words_of_caution(const TrainReport& report) {
  std::vector<std::string> words;
  const auto clips = clips_of_styles(report.walks);
  int used = 0, styled = 0;
  for (const WalkUse& use : report.walks.uses)
    used += use.used, styled += use.used && !use.style.empty();
  std::string single;
  for (const auto& [style, count] : clips)
    if (count == 1) append_name(single, style);
  if (!single.empty())
    words.push_back("styles with one clip, whose recognition could not be validated: " + single);
  if (clips.size() == 1) words.push_back("one style alone: there is nothing to tell apart");
  if (styled > 0 && styled < used)
    words.push_back(std::to_string(used - styled) + " of " + std::to_string(used) +
                    " clips have no style: steps are learnt from them, styles are not");
  if (report.selected.folds > 0 && report.selected.subjects == 0)
    words.push_back("clips name no subjects, or one alone: how strangers fare was not validated");
  if (report.selected.folds == 0)
    words.push_back("a single clip: nothing could be validated on motion the model has not seen");
  return words;
}

void print_clips(const TrainReport& report) {
  std::printf("  %-34s %-14s %5s %8s %6s  %s\n", "clip", "style", "steps", "seconds", "m/s", "");
  for (std::size_t i = 0; i < report.walks.uses.size(); ++i) {
    const WalkUse& use = report.walks.uses[i];
    const WalkFile& file = report.read.files[i];
    std::string remark = joined(use.treadmill ? "treadmill" : "", joined(use.remark, file.remark));
    if (!use.used) remark = joined("NOT USED: " + use.why_not, remark);
    std::printf("  %-34s %-14s %5d %8.2f %6.2f  %s\n", utf8_of(file.path.filename()).c_str(),
                use.style.empty() ? "-" : use.style.c_str(), use.steps, use.seconds, use.speed,
                remark.c_str());
  }
}

void print_validation(const TrainReport& report) {
  const Training& training = report.selected.model.training;
  std::printf("Regularisation %g, %s\n", training.regularisation,
              training.regularisation_chosen_by.c_str());
  if (!report.selected.trials.empty()) {
    const bool subjects = report.selected.subjects > 0;
    std::printf("  %14s %7s %10s  %s\n", "regularisation", "rounds", "hips' frame",
                subjects ? "error on subjects left out" : "error on held-out clips");
    for (const Trial& trial : report.selected.trials)
      std::printf("  %14g %7d %6.1f deg  %.3f deg\n", trial.regularisation, trial.rounds,
                  trial.hips_frame * degrees, trial.error * degrees);
  }
  if (report.selected.folds == 0) return;
  if (report.selected.subjects > 0) {
    std::printf("Strangers (each of %d subjects left out, means over them):\n",
                report.selected.subjects);
    std::printf("  %-22s %8.3f deg  mean angle between found and true joints, hips among them\n",
                "error", training.strangers_error * degrees);
    std::printf("  %-22s %8.3f      share of frames with the right step\n", "step accuracy",
                training.strangers_step_accuracy);
    if (training.validated_step_accuracy <= 0) return;
    std::printf("Known people, on held-out clips (%d folds):\n", report.selected.folds);
  } else {
    std::printf("On held-out clips (%d folds):\n", report.selected.folds);
  }
  std::printf("  %-22s %8.3f deg  mean angle between found and true joints, hips among them\n",
              "error", training.validated_error * degrees);
  std::printf("  %-22s %8.3f      share of frames with the right step\n", "step accuracy",
              training.validated_step_accuracy);
  if (training.validated_style_accuracy > 0) {
    std::printf("  %-22s %8.3f      share of frames with the right style\n", "style accuracy",
                training.validated_style_accuracy);
    std::printf("  %-22s %8.3f      gap between how sure of the style and how often right\n",
                "calibration error", training.validated_calibration_error);
  }
}

}  // namespace

void print_table(const TrainReport& report) {
  const Model& model = report.selected.model;
  print_clips(report);
  std::printf("%zu of %zu clips used, %zu styles, at %g frames/s\n", report.walks.sequences.size(),
              report.walks.uses.size(), report.walks.styles.size(), model.frame_rate);
  for (const std::string& word : words_of_caution(report)) std::printf("Note: %s\n", word.c_str());
  std::printf(
      "Observation: %d values of %zu input joints (%d of %d values move), "
      "%d of %zu output joints (%d of %d move)\n",
      model.input.size(), model.inputs.size(), model.input.statics(), model.input.values,
      model.output.size(), model.outputs.size(), model.output.statics(), model.output.values);
  print_validation(report);
  const Training& training = model.training;
  if (training.log_likelihood.empty())
    std::printf("States: equal parts of each step, no round of Baum-Welch\n");
  for (std::size_t i = 0; i < training.log_likelihood.size(); ++i)
    std::printf("Round %zu of Baum-Welch: log-likelihood %.1f, penalised %.1f\n", i + 1,
                training.log_likelihood[i], training.penalised_log_likelihood[i]);
  std::printf("%s: written, %.1f s on %d thread%s\n", report.output.c_str(), report.seconds,
              report.threads, report.threads == 1 ? "" : "s");
}

void print_json(const TrainReport& report) {
  const Model& model = report.selected.model;
  const Training& training = model.training;
  ordered_json clips = ordered_json::array(), trials = ordered_json::array();
  for (std::size_t i = 0; i < report.walks.uses.size(); ++i) {
    const WalkUse& use = report.walks.uses[i];
    const Walk& walk = report.read.walks[i];
    const WalkFile& file = report.read.files[i];
    clips.push_back({{"file", utf8_of(file.path)},
                     {"style", use.style},
                     {"subject", walk.subject},
                     {"used", use.used},
                     {"why_not", use.why_not},
                     {"remark", joined(use.remark, file.remark)},
                     {"steps", use.steps},
                     {"seconds", use.seconds},
                     {"speed", use.speed},
                     {"treadmill", use.treadmill}});
  }
  for (const Trial& trial : report.selected.trials)
    trials.push_back({{"regularisation", trial.regularisation},
                      {"rounds", trial.rounds},
                      {"hips_frame_deg", trial.hips_frame * degrees},
                      {"error_deg", trial.error * degrees}});
  ordered_json out{{"model", report.output},
                   {"synthetic", training.synthetic},
                   {"frame_rate", model.frame_rate},
                   {"clips", clips},
                   {"clips_used", report.walks.sequences.size()},
                   {"styles", report.walks.styles},
                   {"notes", words_of_caution(report)},
                   {"observation",
                    {{"input", model.input.size()},
                     {"input_values_moving", model.input.statics()},
                     {"output", model.output.size()},
                     {"output_values_moving", model.output.statics()}}},
                   {"states_per_label", model.labels.front().states.size()},
                   {"regularisation", training.regularisation},
                   {"regularisation_chosen_by", training.regularisation_chosen_by},
                   {"rounds", training.log_likelihood.size()},
                   {"trials", trials},
                   {"folds", report.selected.folds},
                   {"subjects_left_out", report.selected.subjects},
                   {"hips_frame_deg", model.body ? model.body->hips_frame * degrees : 0},
                   {"validated", nullptr},
                   {"log_likelihood", training.log_likelihood},
                   {"penalised_log_likelihood", training.penalised_log_likelihood},
                   {"seconds", report.seconds},
                   {"threads", report.threads}};
  if (report.selected.folds > 0) {
    out["validated"] = {{"output_error_deg", training.validated_error * degrees},
                        {"step_accuracy", training.validated_step_accuracy}};
    if (report.selected.subjects > 0)
      out["validated"]["strangers"] = {{"output_error_deg", training.strangers_error * degrees},
                                       {"step_accuracy", training.strangers_step_accuracy}};
    if (training.validated_style_accuracy > 0) {
      out["validated"]["style_accuracy"] = training.validated_style_accuracy;
      out["validated"]["calibration_error"] = training.validated_calibration_error;
    }
  }
  print_report(out);
}

}  // namespace gait::tool
