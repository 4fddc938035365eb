// gait walk: a walk at any speed, on legs of any length, out of nothing.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clip_reader.h"
#include "commands.h"
#include "gait/corpus/demo_model.h"
#include "gait/files/bvh.h"
#include "gait/offline/planned_walk.h"
#include "model_argument.h"
#include "number_range.h"
#include "output_file.h"
#include "speed_words.h"
#include "walk_output.h"

namespace gait::tool {

namespace {

struct WalkOptionsSaid {
  std::string model, output, speed, subject, law = "feet";
  std::optional<double> leg_length, rate;
  double seconds = 0, turn = 0;
};

SpeedWalkPlan plan_of(const WalkOptionsSaid& options) {
  const std::vector<double> speeds = speeds_said(options.speed, ':', "--speed");
  if (speeds.size() > 2)
    throw UsageError("--speed " + options.speed + ": expected one speed or FROM:TO");
  SpeedWalkPlan plan;
  plan.from = speeds.front();
  plan.to = speeds.back();
  plan.leg_length = options.leg_length.value_or(0);
  plan.subject = options.subject;
  plan.law = options.law == "fitted"  ? SpeedLaw::fitted
             : options.law == "inman" ? SpeedLaw::inman
                                      : SpeedLaw::feet;
  plan.seconds = options.seconds;
  plan.turn = options.turn * degree;
  plan.frame_rate = options.rate.value_or(0);
  return plan;
}

void walk(const WalkOptionsSaid& options) {
  const SpeedWalkPlan plan = plan_of(options);
  OutputFile output(options.output);
  const auto model = std::make_shared<const Model>(model_named(options.model));
  const SpeedWalk walked = speed_walk(model, plan);
  print_warnings("walk", walked.remarks);
  write_bvh(bvh_from_clip(walked.clip), output.part());
  output.keep();
}

}  // namespace

Command walk_command(CLI::App& program) {
  const auto options = std::make_shared<WalkOptionsSaid>();
  CLI::App* app = program.add_subcommand("walk", "Walk at a speed, on legs of a length");
  add_model_argument(*app, options->model);
  app->add_option("--speed", options->speed,
                  "m/s, or with the suffix km/h; FROM:TO changes on the way; 0 stands")
      ->required()
      ->type_name("V|FROM:TO");
  app->add_option("--seconds", options->seconds, "Seconds to walk")
      ->required()
      ->default_str("")
      ->check(within(0.1, 7200.0))
      ->type_name("S");
  app->add_option("--leg", options->leg_length, "Thigh and shank in metres (the subject's own)")
      ->check(within(0.01, 100.0))
      ->type_name("METRES");
  app->add_option("--subject", options->subject, "Whose walk (the mean of all)")->type_name("NAME");
  app->add_option("--law", options->law,
                  "Cadence: feet (neither speed nor feet lie), fitted (as the subject's), inman")
      ->check(CLI::IsMember({"fitted", "inman", "feet"}).description(""))
      ->type_name("fitted|inman|feet");
  add_walk_output(*app, options->turn, options->rate, options->output);
  app->footer(
      "Speeds from 0 to 10 km/h are walked; others are clamped to that, with a word.\n\n"
      "Examples:\n"
      "  gait walk speeds.gait --speed 1.4 --seconds 10 -o walk.bvh\n"
      "  gait walk speeds.gait --speed 0:7km/h --seconds 12 -o faster.bvh\n"
      "  gait walk speeds.gait --speed 4km/h --leg 0.7 --subject 08 --seconds 10 -o small.bvh");
  return {app, [options] { walk(*options); }};
}

}  // namespace gait::tool
