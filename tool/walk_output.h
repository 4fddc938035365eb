// What `synth` and `walk` share, which write a walk that no clip holds: its length, its way, its
// frame rate and its file.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "gait/motion/clip.h"

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

// Writes the clip that `walk` gives as a BVH file. Throws Error when there is no place for it,
// before `walk` is called.
void write_walk(const WalkOutput& output, const std::function<Clip()>& walk);

}  // namespace gait::tool
