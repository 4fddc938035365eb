// gait walk: writes a walk at any speed, on legs of any length, without an input clip.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clip_reader.h"
#include "commands.h"
#include "gait/corpus/demo_model.h"
#include "gait/offline/planned_walk.h"
#include "option_kinds.h"
#include "speed_words.h"
#include "walk_output.h"

namespace gait::tool {

namespace {

struct WalkOptionsSaid {
  std::string model, speed, subject, law = "feet";
  std::optional<double> leg_length;
  double seconds = 0;
  WalkOutput walk;
};

SpeedWalkPlan plan_of(const WalkOptionsSaid& options) {
  const std::vector<double> speeds = parse_speeds(options.speed, ':', "--speed");
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
  plan.turn = options.walk.turn_in_radians();
  plan.frame_rate = options.walk.rate;
  return plan;
}

void walk(const WalkOptionsSaid& options) {
  const SpeedWalkPlan plan = plan_of(options);
  write_walk(options.walk, [&] {
    const auto model = std::make_shared<const Model>(model_named(options.model));
    SpeedWalk walked = speed_walk(model, plan);
    print_warnings("walk", walked.remarks);
    return walked.clip;
  });
}

void add_options(CLI::App& app, WalkOptionsSaid& options) {
  add_model_argument(app, options.model);
  add_value(app, "--speed", "V|FROM:TO", options.speed,
            "m/s, or with the suffix km/h; FROM:TO changes on the way; 0 stands")
      ->required();
  add_value(app, "--seconds", "S", options.seconds, "Seconds to walk")
      ->required()
      ->default_str("")
      ->check(walk_seconds());
  add_value(app, "--leg", "METRES", options.leg_length,
            "Thigh and shank in metres (the subject's own)")
      ->check(within(0.01, 100));
  add_value(app, "--subject", "NAME", options.subject, "Whose walk (the mean of all)");
  add_choice(
      app, "--law", {"fitted", "inman", "feet"}, options.law,
      "Cadence: feet (steps carry the body at the speed), fitted (the subject's law), inman");
  add_walk_output(app, options.walk);
  app.footer(R"(Speeds from 0 to 10 km/h are walked; others are clamped to that, with a warning.

Examples:
  gait walk speeds.gait --speed 1.4 --seconds 10 -o walk.bvh
  gait walk speeds.gait --speed 0:7km/h --seconds 12 -o faster.bvh
  gait walk speeds.gait --speed 4km/h --leg 0.7 --subject 08 --seconds 10 -o small.bvh)");
}

}  // namespace

Command walk_command(CLI::App& program) {
  return make_command(program, "walk", "Walk at a speed, on legs of a length", add_options, walk);
}

}  // namespace gait::tool
