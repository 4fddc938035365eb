// gait render: clips as a film strip of stick figures, or as a film.
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "clip_reader.h"
#include "commands.h"
#include "draw/film.h"
#include "draw/film_strip.h"
#include "draw/speed_grid.h"
#include "draw/walk_view.h"
#include "file_ending.h"
#include "gait/corpus/demo_model.h"
#include "gait/error.h"
#include "gait/numbers.h"
#include "gait/platform/path_text.h"
#include "option_kinds.h"
#include "progress.h"
#include "speed_words.h"

namespace gait::tool {

namespace {

struct RenderOptions {
  std::vector<std::string> clips;
  std::string output;
  int strobe = 0;
  std::string compare;
  std::string view = "side";
  std::string speeds, legs;
  ClipReading reading;
};

// Degrees around the walker: 0 in front, 90 at the right side. NaN for what is neither.
double camera_degrees(const std::string& view) {
  if (view == "side") return 90;
  if (view == "front") return 0;
  const auto degrees = number_in(view);
  return degrees && std::abs(*degrees) <= 360 ? *degrees : NAN;
}

std::string view_fault(const std::string& view) {
  return std::isnan(camera_degrees(view))
             ? "'" + view + "' is no view: side, front or degrees from -360 to 360"
             : "";
}

WalkView view_clip(const std::string& path, const RenderOptions& options) {
  const ReadClip read = read_clip(path_from_utf8(path), options.reading);
  print_doubts("render", read, false);
  warn_of_roles("render", options.reading, read.roles_without_joint);
  if (read.clip.frames() == 0) throw Error(path + ": has no frames, nothing to draw");
  WalkView view = view_walk(read.clip, read.roles, camera_degrees(options.view));
  view.name = utf8_of(path_from_utf8(path).stem());
  return view;
}

// What a model's speed walker walks, instead of clips.
void render_speeds(const RenderOptions& options, const std::string& ending) {
  if (options.speeds.empty() || options.clips.size() != 1)
    throw UsageError("--speeds and --legs go together with one model in place of the clips");
  if (ending == ".mp4" || options.strobe > 0 || !options.compare.empty())
    throw UsageError("--speeds gives a picture (.png, .svg) without --strobe or --compare");
  SpeedGrid grid;
  grid.speeds = parse_speeds(options.speeds, ',', "--speeds");
  if (!options.legs.empty()) grid.leg_lengths = parse_lengths(options.legs, "--legs");
  grid.camera_degrees = camera_degrees(options.view);
  const auto model = std::make_shared<const Model>(model_named(options.clips.front()));
  write_speed_grid(model, grid, path_from_utf8(options.output));
}

void render(const RenderOptions& options) {
  const std::string ending = ending_of(path_from_utf8(options.output));
  if (ending != ".png" && ending != ".svg" && ending != ".mp4")
    throw UsageError("-o " + options.output + ": expected a name that ends in .png, .svg or .mp4");
  if (!options.compare.empty() && options.clips.size() != 1)
    throw UsageError("--compare goes with one clip, " + std::to_string(options.clips.size()) +
                     " were given");

  if (!options.speeds.empty() || !options.legs.empty()) {
    render_speeds(options, ending);
    return;
  }

  std::vector<WalkView> views;
  for (const std::string& clip : options.clips) views.push_back(view_clip(clip, options));
  std::unique_ptr<WalkView> compared;
  if (!options.compare.empty())
    compared = std::make_unique<WalkView>(view_clip(options.compare, options));

  if (ending == ".mp4") {
    Progress progress("gait render: drawing the film");
    write_film(views, compared.get(), path_from_utf8(options.output),
               [&](double share) { progress.show(share); });
  } else {
    write_film_strip(views, compared.get(), options.strobe, path_from_utf8(options.output));
  }
}

void add_options(CLI::App& app, RenderOptions& options) {
  add_argument(app, "CLIP", options.clips, "BVH files, one row each; with --speeds a model");
  add_output(app, "FILE", options.output,
             "What to write: a picture (.png, .svg) or, where ffmpeg is, a film (.mp4)");
  add_value(app, "--strobe", "N", options.strobe,
            "Figures per row (about 12, as the walk's length asks)")
      ->check(CLI::Range(1, 200))
      ->default_str("");
  add_value(app, "--compare", "BVH", options.compare,
            "Another clip, drawn in grey behind the same moments, hips on hips");
  add_value(app, "--view", "VIEW", options.view,
            "Camera: side, front, or degrees around the walker (0 front, 90 right side)")
      ->check(CLI::Validator(view_fault, ""));
  add_value(app, "--speeds", "V,V,..", options.speeds,
            "Draw a model's walk at these speeds instead: m/s, or 2,4,6,8,10km/h");
  add_value(app, "--legs", "M,M,..", options.legs,
            "With --speeds: a row for each length of thigh and shank, in metres");
  add_clip_reading(app, options.reading);
  app.footer(
      R"(A walk's figures stand where they were. One that stays on the spot is spread by time.

Examples:
  gait render walk.bvh -o walk.png
  gait render proud.bvh sad.bvh drunk.bvh -o styles.svg --strobe 9
  gait render captured.bvh --compare reconstructed.bvh -o both.png
  gait render speeds.gait --speeds 2,4,6,8,10km/h --legs 0.7,0.83,0.95 -o speeds.png
  gait render walk.bvh --view 45 -o walk.mp4)");
}

}  // namespace

Command render_command(CLI::App& program) {
  return make_command(program, "render",
                      "Draw clips as a film strip of stick figures, or as a film", add_options,
                      render);
}

}  // namespace gait::tool
