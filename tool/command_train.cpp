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
#include "gait/teach/walk_model.h"
#include "gait/teach/walks_over_speed.h"
#include "interrupt.h"
#include "number_range.h"
#include "output_file.h"
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
    // Ascending, each once, whatever order they were said in.
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

// Now, or the moment that a build which is to be repeated says it is
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

struct Trained {
  WalksRead read;
  WalkSequences walks;
  Selected selected;
};

Trained learn_from(const TrainOptions& options, const Interrupt& interrupt) {
  Progress progress("gait train:");
  Trained trained;
  trained.read = read_walks(options.reading, "train", [&](double share, const std::string& file) {
    interrupt.check();
    progress.show(0.2 * share, "reading " + file);
  });
  interrupt.check();
  progress.show(0.2, "finding steps");
  if (options.reading.calibrate)
    for (Walk& walk : trained.read.walks)
      walk.clip = calibrated(walk.clip, trained.read.walks.front().clip.skeleton);
  trained.walks = walk_sequences(trained.read.walks, walk_options_of(options, trained.read.roles));
  interrupt.check();

  SelectionOptions selection = selection_of(options);
  selection.learning.hmm.cancel = interrupt.cancel();
  selection.learning.hmm.progress = [&](double share, const std::string& what) {
    progress.show(0.3 + 0.7 * share, what);
  };
  ModelOrigin origin;
  origin.name = std::filesystem::path(options.output).stem().string();
  origin.date = date_of_training();
  origin.comment = options.comment;
  origin.synthetic = options.synthetic;
  trained.selected = select_walk_model(trained.walks, selection, origin);
  add_style_space(trained.selected.model, trained.read.walks, {}, trained.read.roles);
  interrupt.check();
  SpeedOptions speeds;
  speeds.roles = trained.read.roles;
  add_speed_spaces(trained.selected.model, trained.read.walks, speeds);
  interrupt.check();
  // Where the clips lay says something of this machine and nothing of the model.
  for (std::string& clip : trained.selected.model.training.clips)
    clip = std::filesystem::path(clip).filename().string();
  return trained;
}

void train(const TrainOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  OutputFile output(options.output);
  const Interrupt interrupt;
  const Trained trained = learn_from(options, interrupt);
  write_model(trained.selected.model, output.part());
  output.keep();

  TrainReport report{trained.read, trained.walks, trained.selected, options.output, 0, 0};
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report.threads = threads_to_use(options.threads.value_or(0));
  if (options.json)
    print_json(report);
  else
    print_table(report);
}

}  // namespace

Command train_command(CLI::App& program) {
  const auto options = std::make_shared<TrainOptions>();
  CLI::App* app = program.add_subcommand("train", "Learn a model from captured walks");
  add_walk_reading(*app, options->reading);
  app->add_option("-o,--output", options->output, "Model to write")
      ->required()
      ->type_name("M.gait");
  app->add_option("--states", options->states, "States per step (8)")
      ->check(CLI::Range(1, 100))
      ->type_name("N");
  app->add_option("--output-joints", options->output_joints,
                  "Joints to synthesise, a,b,... (hips and legs)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->default_str("")
      ->type_name("NAMES");
  app->add_option("--input-joints", options->input_joints,
                  "Joints that are measured, a,b,... (all but hips and legs)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->default_str("")
      ->type_name("NAMES");
  app->add_option("--rate", options->rate,
                  "The model's frames per second (30, or the clips' own when slower)")
      ->check(within(5.0, 240.0))
      ->type_name("HZ");
  app->add_option("--history", options->history,
                  "How far back inputs are compared with themselves, in ms (33.3,166.7,333.3)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->default_str("")
      ->check(within(1.0, 2000.0))
      ->type_name("MS,MS,..");
  app->add_option("--regularisation", options->regularisation,
                  "How firmly covariances are held, in frames (by cross-validation)")
      ->check(within(0.01, 1e6))
      ->type_name("K");
  app->add_option("--placement", options->placement,
                  "How far a live performer's sensors may sit or be calibrated off, in degrees")
      ->check(within(0.0, 30.0))
      ->capture_default_str()
      ->type_name("DEG");
  app->add_option("--rounds", options->rounds, "Rounds of Baum-Welch (by cross-validation)")
      ->check(CLI::Range(0, 100))
      ->type_name("N");
  add_decoder(*app, options->decoder, "How the model decodes unless told otherwise (viterbi)");
  app->add_option("--threads", options->threads,
                  "Threads to learn with; the model is the same for any number (all processors)")
      ->check(CLI::Range(1, 256))
      ->type_name("N");
  app->add_option("--comment", options->comment, "A sentence to keep in the model")
      ->type_name("TEXT");
  app->add_flag("--synthetic", options->synthetic,
                "Keep in the model that nobody walked these walks");
  app->add_flag("--json", options->json, "Report as JSON");
  app->footer(std::string(label_help) +
              "\n\nExamples:\n"
              "  gait train walks -o walks.gait\n"
              "  gait train takes/*.bvh -o takes.gait --label '{subject}_{style}_{take}.bvh'\n"
              "  gait train --manifest walks.csv -o walks.gait --states 5 --threads 2\n"
              "  gait train walks -o arms.gait --output-joints LeftArm,RightArm");
  return {app, [options] { train(*options); }};
}

}  // namespace gait::tool
