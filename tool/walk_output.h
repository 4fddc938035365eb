// What `synth` and `walk` share, which write a walk that no clip holds: its length, its way, its
// frame rate and its file.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace gait::tool {

struct WalkOutput {
  double turn = 0;   // --turn, degrees per second, above 0 to the left
  double rate = 0;   // --rate, frames per second; 0: the model's
  std::string path;  // -o

  double turn_in_radians() const;
};

// Adds --turn, --rate and -o.
void add_walk_output(CLI::App& app, WalkOutput& output);

// Checks --seconds, how long to walk.
CLI::Validator walk_seconds();

}  // namespace gait::tool
