// gait synth: writes a walk of any length in a model's styles, without an input clip.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "gait/corpus/demo_model.h"
#include "gait/offline/planned_walk.h"
#include "option_kinds.h"
#include "style_words.h"
#include "walk_output.h"

namespace gait::tool {

namespace {

struct SynthOptions {
  std::string model, style, mix, engine = "style";
  std::vector<std::string> changes;
  std::optional<double> variation, exaggeration, seconds;
  std::optional<int> cycles;
  std::optional<std::uint64_t> seed;
  WalkOutput walk;
};

StyledWalkPlan plan_of(const SynthOptions& options) {
  if (options.style.empty() == options.mix.empty())
    throw UsageError("expected either --style NAME or --mix NAME=WEIGHT,...");
  if (options.cycles.has_value() == options.seconds.has_value())
    throw UsageError("expected either --cycles N or --seconds S");
  if (options.engine == "step" && (options.variation || options.exaggeration || options.seed))
    throw UsageError("--variation, --exaggeration and --seed go with --engine style");
  StyledWalkPlan plan;
  plan.mix = options.style.empty() ? parse_mix(options.mix, "--mix")
                                   : std::vector<StyleShare>{{options.style, 1}};
  for (const std::string& change : options.changes)
    plan.changes.push_back(parse_change(change, "--then"));
  std::stable_sort(plan.changes.begin(), plan.changes.end(),
                   [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  plan.variation = options.variation.value_or(1);
  plan.exaggeration = options.exaggeration.value_or(1);
  plan.cycles = options.cycles.value_or(0);
  plan.seconds = options.seconds.value_or(0);
  plan.seed = options.seed.value_or(1);
  plan.turn = options.walk.turn_in_radians();
  plan.frame_rate = options.walk.rate;
  return plan;
}

void synth(const SynthOptions& options) {
  const StyledWalkPlan plan = plan_of(options);
  write_walk(options.walk, [&] {
    const auto model = std::make_shared<const Model>(model_named(options.model));
    return options.engine == "step" ? stepped_walk(model, plan) : styled_walk(model, plan);
  });
}

void add_options(CLI::App& app, SynthOptions& options) {
  add_model_argument(app, options.model);
  add_value(app, "--style", "NAME", options.style, "Style to walk in");
  add_value(app, "--mix", "MIX", options.mix, "Styles by weight: proud=0.7,sad=0.3");
  add_value(app, "--then", "NAME@S", options.changes,
            "Go over to another style or mix at this second; may be repeated")
      ->allow_extra_args(false)
      ->default_str("");
  add_choice(app, "--engine", {"style", "step"}, options.engine,
             "style: cycles that vary as captured ones do; step: step by step, evenly");
  add_value(app, "--variation", "V", options.variation,
            "How much cycles differ: 0 not at all, 1 as captured, up to 2 (1)")
      ->check(within(0, 2));
  add_value(app, "--exaggeration", "X", options.exaggeration,
            "0: the mean of all styles, 1: the style, up to 3: a caricature (1)")
      ->check(within(-1, 3));
  add_value(app, "--cycles", "N", options.cycles,
            "Cycles to walk, from right contact to right contact")
      ->check(CLI::Range(1, 10000));
  add_value(app, "--seconds", "S", options.seconds, "Seconds to walk")->check(walk_seconds());
  add_value(app, "--seed", "N", options.seed, "The same seed gives the same walk (1)")
      ->check(seed_check());
  add_walk_output(app, options.walk);
  app.footer(
      R"(The walk is under way when the file begins, at a right contact, and goes where its own feet
take it.

Examples:
  gait synth walks.gait --style sad --cycles 20 -o sad.bvh
  gait synth walks.gait --mix proud=0.7,drunk=0.3 --seconds 30 --seed 7 -o mixed.bvh
  gait synth walks.gait --style proud --then sad@4 --seconds 8 -o change.bvh)");
}

}  // namespace

Command synth_command(CLI::App& program) {
  return make_command(program, "synth", "Walk in a style, or a mix of them", add_options, synth);
}

}  // namespace gait::tool
