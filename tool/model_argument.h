// MODEL, the first argument of every subcommand that uses one.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace gait::tool {

// A file, or a name that model_named knows.
void add_model_argument(CLI::App& command, std::string& model);

}  // namespace gait::tool
