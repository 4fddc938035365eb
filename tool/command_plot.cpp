// gait plot: what a model holds, as the papers' figures.
#include <cstdint>
#include <memory>
#include <string>

#include "commands.h"
#include "draw/model_figures.h"
#include "file_ending.h"
#include "gait/corpus/demo_model.h"
#include "option_kinds.h"

namespace gait::tool {

namespace {

struct PlotOptions {
  std::string model, what, output, subject;
  std::uint64_t seed = 1;
};

Chart figure_of(const PlotOptions& options) {
  const auto model = std::make_shared<const Model>(model_named(options.model));
  if (options.what == "variance") return variance_figure(*model);
  if (options.what == "scores") return scores_figure(*model);
  if (options.what == "cycles") return cycles_figure(model, options.seed);
  if (options.what == "speed") return speed_figure(*model, options.subject);
  return frequency_figure(model);
}

void plot(const PlotOptions& options) {
  const std::filesystem::path output = path_from_utf8(options.output);
  const std::string ending = ending_of(output);
  if (ending != ".png" && ending != ".svg")
    throw UsageError("-o " + options.output + ": expected a name that ends in .svg or .png");
  write_chart(figure_of(options), output);
}

void add_options(CLI::App& app, PlotOptions& options) {
  add_model_argument(app, options.model);
  add_argument(app, "WHAT", options.what, "variance, scores, cycles, speed or frequency")
      ->check(one_of({"variance", "scores", "cycles", "speed", "frequency"}));
  add_output(app, "SVG|PNG", options.output, "Figure to write");
  add_value(app, "--subject", "NAME", options.subject,
            "With speed: in this subject's own space (all in the one they share)");
  add_value(app, "--seed", "N", options.seed, "With cycles: of the walks that are drawn")
      ->check(seed_check());
  app.footer(R"(variance    cumulated variance over components, a line per space
scores      first scores of each style's cycles
cycles      durations and first scores of cycles that follow each other
speed       scores over speed, with standing
frequency   cycles per second over speed, with Inman's law

Examples:
  gait plot walks.gait variance -o variance.svg
  gait plot speeds.gait speed --subject 08 -o speed.png)");
}

}  // namespace

Command plot_command(CLI::App& program) {
  return make_command(program, "plot", "Draw what a model holds", add_options, plot);
}

}  // namespace gait::tool
