#include "walk_output.h"

#include <numbers>

#include "gait/files/bvh.h"
#include "gait/platform/path_text.h"
#include "gait/platform/whole_file.h"
#include "option_kinds.h"

namespace gait::tool {

double WalkOutput::turn_in_radians() const { return turn * (std::numbers::pi / 180); }

void add_walk_output(CLI::App& app, WalkOutput& output) {
  add_value(app, "--turn", "DEG_PER_S", output.turn, "Turn on the way, above 0 to the left")
      ->check(within(-180, 180));
  add_value(app, "--rate", "HZ", output.rate, "Frames per second to write (the model's)")
      ->check(within(5, 240))
      ->default_str("");
  add_output(app, "BVH", output.path, "BVH file to write, in metres");
}

CLI::Validator walk_seconds() { return within(0.1, 7200); }

void write_walk(const WalkOutput& output, const std::function<Clip()>& walk) {
  WholeFile file(path_from_utf8(output.path));
  write_bvh(bvh_from_clip(walk()), file.part());
  file.keep();
}

}  // namespace gait::tool
