// Numbers as they are said on the command line, whole words or not at all.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string_view>

namespace gait::tool {

// Nothing when `text` is more or less than one finite number.
std::optional<double> number_said(std::string_view text);

// Checks a seed: CLI11 would read "-3" as a very large number.
CLI::Validator seed_check();

}  // namespace gait::tool
