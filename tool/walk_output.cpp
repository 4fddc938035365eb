#include "walk_output.h"

#include "number_range.h"

namespace gait::tool {

void add_walk_output(CLI::App& command, double& turn, std::optional<double>& rate,
                     std::string& output) {
  command.add_option("--turn", turn, "Turn on the way, above 0 to the left")
      ->check(within(-180.0, 180.0))
      ->type_name("DEG_PER_S");
  command.add_option("--rate", rate, "Frames per second to write (the model's)")
      ->check(within(5.0, 240.0))
      ->type_name("HZ");
  command.add_option("-o,--output", output, "BVH file to write, in metres")
      ->required()
      ->type_name("BVH");
}

}  // namespace gait::tool
