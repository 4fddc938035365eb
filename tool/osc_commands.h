// The subcommands that send and receive live motion; there where liblo is.
#pragma once

#include "commands.h"

namespace gait::tool {

Command stream_command(CLI::App& program);
Command listen_command(CLI::App& program);

}  // namespace gait::tool
