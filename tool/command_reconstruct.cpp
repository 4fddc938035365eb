// gait reconstruct: a clip's output joints from its input joints alone.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "clip_reader.h"
#include "commands.h"
#include "decision_table.h"
#include "gait/corpus/demo_model.h"
#include "gait/files/whole_file.h"
#include "gait/offline/reconstructed_file.h"
#include "option_kinds.h"
#include "play_options.h"

namespace gait::tool {

namespace {

struct ReconstructOptions {
  std::string model, clip, output, table;
  std::string root = "feet";
  PlaySettings settings;
  ClipReading reading;
  bool calibrate = false;
};

void reconstruct(const ReconstructOptions& options) {
  WholeFile output(options.output);
  std::optional<WholeFile> table;
  if (!options.table.empty()) table.emplace(options.table);

  const auto model = std::make_shared<const Model>(model_named(options.model));
  const BvhFile file = read_bvh(options.clip);
  print_warnings("reconstruct", file.warnings);
  const ReconstructedFile result =
      reconstruct_file(model, file, said_of_frame(options.reading), options.settings,
                       options.root == "feet" ? FileRoot::feet : FileRoot::file, options.calibrate);
  print_warnings("reconstruct", result.warnings);
  write_bvh(result.file, output.part());
  if (table) write_decisions(result.walk, *model, table->part());
  output.keep();
  if (table) table->keep();
}

void add_options(CLI::App& app, ReconstructOptions& options) {
  add_model_argument(app, options.model);
  add_argument(app, "CLIP", options.clip, "BVH file");
  add_output(app, "BVH", options.output,
             "BVH file to write: same skeleton, rate and frames, input joints untouched");
  add_choice(
      app, "--root", {"feet", "keep"}, options.root,
      "Where the hips go: feet (as the found feet carry them, from the origin ahead; below a "
      "measured head or chest, along its heading) or keep (place and heading of the clip)");
  add_value(app, "--csv", "FILE", options.table,
            "Table to write, a row per frame: time, step, state, log-likelihood, phase, cadence, "
            "style posteriors");
  add_play_options(app, options.settings);
  app.add_flag("--calibrate", options.calibrate,
               "Accept bones that rest in other directions than the model's: turn their joints' "
               "frames to match, and back again");
  add_unit_and_up(app, options.reading);
  app.footer(
      R"(Only the model's input joints are looked at. Delays that --lag or --future ask for are taken
out again: frame t of what is written belongs to frame t of the clip.

Examples:
  gait reconstruct walks.gait upper.bvh -o whole.bvh
  gait reconstruct gait-demo walk.bvh -o found.bvh --csv found.csv --root keep
  gait reconstruct walks.gait walk.bvh -o caricature.bvh --strength 1.5)");
}

}  // namespace

Command reconstruct_command(CLI::App& program) {
  return make_command(program, "reconstruct",
                      "Find the joints a model synthesises from those it is given", add_options,
                      reconstruct);
}

}  // namespace gait::tool
