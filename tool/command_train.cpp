// gait train: clips in, a model out.
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "commands.h"
#include "gait/error.h"
#include "gait/learn/parallel.h"
#include "gait/model/model_file.h"
#include "gait/motion/rest_calibration.h"
#include "gait/platform/path_text.h"
#include "gait/platform/whole_file.h"
#include "gait/teach/walk_model.h"
#include "interrupt.h"
#include "option_kinds.h"
#include "play_options.h"
#include "progress.h"
#include "train_report.h"
#include "walk_files.h"

namespace gait::tool {

namespace {

struct TrainOptions {
  WalkReading reading;
  std::string output, comment;
  std::vector<std::string> input_joints, output_joints;
  std::optional<int> states, rounds, threads;
  std::optional<double> rate, regularisation;
  double placement = 0;         // degrees
  std::vector<double> history;  // ms
  std::optional<DecoderKind> decoder;
  bool synthetic = false, json = false;
};

SelectionOptions selection_of(const TrainOptions& options) {
  SelectionOptions selection;
  if (options.states) selection.learning.states = *options.states;
  if (!options.history.empty()) {
    selection.learning.history.clear();
    // Ascending, each once, in whatever order the option lists them.
    for (const double milliseconds : std::set(options.history.begin(), options.history.end()))
      selection.learning.history.push_back(milliseconds / 1000);
  }
  selection.learning.placement = options.placement * std::numbers::pi / 180;
  selection.learning.hmm.threads = options.threads.value_or(0);
  selection.regularisation = options.regularisation;
  selection.rounds = options.rounds;
  if (options.decoder) selection.decoder = *options.decoder;
  return selection;
}

WalkOptions walk_options_of(const TrainOptions& options, const RoleTable& roles) {
  WalkOptions walk_options;
  walk_options.frame_rate = options.rate.value_or(0);
  walk_options.input_joints = options.input_joints;
  walk_options.output_joints = options.output_joints;
  walk_options.roles = roles;
  return walk_options;
}

// The present moment, or the one that SOURCE_DATE_EPOCH sets, so that a model can be made again to
// the byte
// (reproducible-builds.org/specs/source-date-epoch).
std::string date_of_training() {
  std::time_t now = std::time(nullptr);
  if (const char* said = std::getenv("SOURCE_DATE_EPOCH"); said != nullptr && *said != '\0')
    now = static_cast<std::time_t>(std::strtoll(said, nullptr, 10));
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

WalksRead read_clips(const TrainOptions& options, const Interrupt& interrupt, Progress& progress) {
  WalksRead read = read_walks(options.reading, "train", [&](double share, const std::string& file) {
    interrupt.check();
    progress.show(0.2 * share, "reading " + file);
  });
  interrupt.check();
  if (options.reading.calibrate)
    for (Walk& walk : read.walks)
      walk.clip = calibrated(walk.clip, read.walks.front().clip.skeleton);
  return read;
}

LearntWalks learn_from(const WalksRead& read, const TrainOptions& options,
                       const Interrupt& interrupt, Progress& progress) {
  progress.show(0.2, "finding steps");
  SelectionOptions selection = selection_of(options);
  selection.learning.hmm.cancel = interrupt.cancel();
  selection.learning.hmm.progress = [&](double share, const std::string& what) {
    progress.show(0.3 + 0.7 * share, what);
  };
  ModelOrigin origin;
  origin.name = utf8_of(path_from_utf8(options.output).stem());
  origin.date = date_of_training();
  origin.comment = options.comment;
  origin.synthetic = options.synthetic;
  LearntWalks learnt =
      learn_walks(read.walks, read.walks, walk_options_of(options, read.roles), selection, origin);
  // A model keeps the names of its clips, not the folders that they lay in on this machine.
  for (std::string& clip : learnt.selected.model.training.clips)
    clip = utf8_of(path_from_utf8(clip).filename());
  return learnt;
}

void train(const TrainOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  WholeFile output(path_from_utf8(options.output));
  const Interrupt interrupt;
  WalksRead read;
  LearntWalks learnt;
  {
    Progress progress("gait train:");
    read = read_clips(options, interrupt, progress);
    learnt = learn_from(read, options, interrupt, progress);
  }
  write_model(learnt.selected.model, output.part());
  output.keep();

  TrainReport report{read, learnt.sequences, learnt.selected, options.output, 0, 0};
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.threads = threads_to_use(options.threads.value_or(0));
  if (options.json)
    print_json(report);
  else
    print_table(report);
}

void add_options(CLI::App& app, TrainOptions& options) {
  add_walk_reading(app, options.reading);
  add_output(app, "M.gait", options.output, "Model to write");
  add_value(app, "--states", "N", options.states, "States per step (8)")->check(CLI::Range(1, 100));
  add_list(app, "--output-joints", "NAMES", options.output_joints,
           "Joints to synthesise, a,b,... (hips and legs)");
  add_list(app, "--input-joints", "NAMES", options.input_joints,
           "Joints that are measured, a,b,... (all but hips and legs)");
  add_value(app, "--rate", "HZ", options.rate,
            "The model's frames per second (30, or the clips' own when slower)")
      ->check(within(5, 240));
  add_list(app, "--history", "MS,MS,..", options.history,
           "How far back inputs are compared with themselves, in ms (33.3,166.7,333.3)")
      ->check(within(1, 2000));
  add_value(app, "--regularisation", "K", options.regularisation,
            "How firmly covariances are held, in frames (by cross-validation)")
      ->check(within(0.01, 1e6));
  add_value(
      app, "--placement", "DEG", options.placement,
      "Error to expect of a live performer's sensors, in placing or calibrating them, in degrees")
      ->check(within(0, 30));
  add_value(app, "--rounds", "N", options.rounds, "Rounds of Baum-Welch (by cross-validation)")
      ->check(CLI::Range(0, 100));
  add_decoder(app, options.decoder, "How the model decodes by default (viterbi)");
  add_value(app, "--threads", "N", options.threads,
            "Threads to learn with; the model is the same for any number (all processors)")
      ->check(CLI::Range(1, 256));
  add_value(app, "--comment", "TEXT", options.comment, "A sentence to keep in the model");
  app.add_flag("--synthetic", options.synthetic,
               "Mark the model as learnt from walks that were computed, not captured");
  add_json_flag(app, options.json);
  app.footer(std::string(label_help) + R"(

Examples:
  gait train walks -o walks.gait
  gait train takes/*.bvh -o takes.gait --label '{subject}_{style}_{take}.bvh'
  gait train --manifest walks.csv -o walks.gait --states 5 --threads 2
  gait train walks -o arms.gait --output-joints LeftArm,RightArm)");
}

}  // namespace

Command train_command(CLI::App& program) {
  return make_command(program, "train", "Learn a model from captured walks", add_options, train);
}

}  // namespace gait::tool
