// What the subcommands that write a walk out of nothing share: its way, its rate and its file.
#pragma once

#include <CLI/CLI.hpp>
#include <numbers>
#include <optional>
#include <string>

namespace gait::tool {

inline constexpr double degree = std::numbers::pi / 180;

// `turn`: degrees per second, above 0 to the left. `rate`: none stays the model's.
void add_walk_output(CLI::App& command, double& turn, std::optional<double>& rate,
                     std::string& output);

}  // namespace gait::tool
