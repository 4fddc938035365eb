// How a model is played, as a subcommand's options: decoder, mapping, trajectory.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "gait/play/stream_reconstructor.h"

namespace gait::tool {

// --decoder viterbi|forward|lag.
void add_decoder(CLI::App& app, std::optional<DecoderKind>& decoder, const std::string& help);

// Adds --decoder, --lag, --temper, --strength, --past, --current and --future.
void add_play_options(CLI::App& app, PlaySettings& settings);

}  // namespace gait::tool
