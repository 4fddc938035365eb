// gait evaluate: a model against the truth in clips.
#include <cstdio>
#include <memory>
#include <string>

#include "commands.h"
#include "evaluation_report.h"
#include "gait/corpus/demo_model.h"
#include "gait/motion/rest_calibration.h"
#include "interrupt.h"
#include "option_kinds.h"
#include "play_options.h"
#include "progress.h"
#include "walk_files.h"

namespace gait::tool {

namespace {

struct EvaluateOptions {
  std::string model;
  WalkReading reading;
  PlaySettings settings;
  double ahead = 0, jitter = 0;  // ms
  double sender_rate = 0;
  bool json = false;
};

Evaluation judge(const std::shared_ptr<const Model>& model, const EvaluateOptions& options) {
  const Interrupt interrupt;
  Progress progress("gait evaluate:");
  WalksRead read =
      read_walks(options.reading, "evaluate", [&](double share, const std::string& file) {
        interrupt.check();
        progress.show(0.3 * share, "reading " + file);
      });
  if (options.reading.calibrate && model->body)
    for (Walk& walk : read.walks) walk.clip = calibrated(walk.clip, model->body->skeleton);
  const SenderManner sender{options.sender_rate, options.jitter / 1000, options.ahead / 1000};
  return evaluate(model, read.walks, options.settings, {sender, read.roles}, [&](double share) {
    interrupt.check();
    progress.show(0.3 + 0.7 * share, "playing");
  });
}

void report(const EvaluateOptions& options) {
  const auto model = std::make_shared<const Model>(model_named(options.model));
  const Evaluation evaluation = judge(model, options);
  for (const std::string& skipped : evaluation.skipped)
    std::fprintf(stderr, "gait evaluate: warning: left out: %s\n", skipped.c_str());
  if (options.json)
    print_json(evaluation, *model);
  else
    print_table(evaluation, *model);
}

void add_options(CLI::App& app, EvaluateOptions& options) {
  add_model_argument(app, options.model);
  add_walk_reading(app, options.reading);
  add_play_options(app, options.settings);
  add_value(app, "--ahead", "MS", options.ahead, "Contacts: how early they are to be heard")
      ->check(CLI::Range(0, 1000));
  add_value(app, "--jitter", "MS", options.jitter, "Contacts: how late a frame may arrive")
      ->check(CLI::Range(0, 1000));
  add_value(app, "--sender-rate", "HZ", options.sender_rate,
            "Contacts: frames a second that arrive; 0: the clip's")
      ->check(CLI::Range(0, 1000));
  add_json_flag(app, options.json, "Report as JSON: every figure, per clip, style and joint");
  app.footer(std::string(label_help) + R"(

Figures are means over clips, and pooled over frames where slow walkers count
for more.

Examples:
  gait evaluate walks.gait unseen/*.bvh
  gait evaluate walks.gait unseen --decoder forward --strength 1.2 --json)");
}

}  // namespace

Command evaluate_command(CLI::App& program) {
  return make_command(program, "evaluate", "Say how well a model does on captured walks",
                      add_options, report);
}

}  // namespace gait::tool
