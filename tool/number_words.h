// Checks of numbers on the command line that CLI11 does not make.
#pragma once

#include <CLI/CLI.hpp>

namespace gait::tool {

// Checks a seed: CLI11 would read "-3" as a very large number.
CLI::Validator seed_check();

}  // namespace gait::tool
