// gait plot: what a model holds, as the papers' figures.
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "commands.h"
#include "draw/model_figures.h"
#include "gait/corpus/demo_model.h"
#include "model_argument.h"
#include "number_words.h"

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
  std::string ending = std::filesystem::path(options.output).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".png" && ending != ".svg")
    throw UsageError("-o " + options.output + ": expected a name that ends in .svg or .png");
  write_chart(figure_of(options), options.output, ending == ".svg");
}

}  // namespace

Command plot_command(CLI::App& program) {
  const auto options = std::make_shared<PlotOptions>();
  CLI::App* app = program.add_subcommand("plot", "Draw what a model holds");
  add_model_argument(*app, options->model);
  app->add_option("WHAT", options->what, "variance, scores, cycles, speed or frequency")
      ->required()
      ->default_str("")
      ->check(CLI::IsMember({"variance", "scores", "cycles", "speed", "frequency"}).description(""))
      ->type_name("");
  app->add_option("-o,--output", options->output, "Figure to write")
      ->required()
      ->type_name("SVG|PNG");
  app->add_option("--subject", options->subject,
                  "With speed: in this subject's own space (all in the one they share)")
      ->type_name("NAME");
  app->add_option("--seed", options->seed, "With cycles: of the walks that are drawn")
      ->check(seed_check())
      ->type_name("N");
  app->footer(
      "variance    cumulated variance over components, a line per space\n"
      "scores      first scores of each style's cycles\n"
      "cycles      durations and first scores of cycles that follow each other\n"
      "speed       scores over speed, with standing\n"
      "frequency   cycles per second over speed, with Inman's law\n\n"
      "Examples:\n"
      "  gait plot walks.gait variance -o variance.svg\n"
      "  gait plot speeds.gait speed --subject 08 -o speed.png");
  return {app, [options] { plot(*options); }};
}

}  // namespace gait::tool
