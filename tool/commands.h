// The subcommands of `gait`, one file each (command_NAME.cpp). Each registers its options with the
// program and gives back what to run when it was chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>

namespace gait::tool {

struct Command {
  CLI::App* app;              // the subcommand, owned by the program
  std::function<void()> run;  // throws Error when the work failed, UsageError when used wrongly
};

// Used wrongly in a way that only shows after the options were read: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

Command corpus_command(CLI::App& program);
Command label_command(CLI::App& program);
Command render_command(CLI::App& program);
Command train_command(CLI::App& program);
Command info_command(CLI::App& program);
Command evaluate_command(CLI::App& program);
Command reconstruct_command(CLI::App& program);
Command synth_command(CLI::App& program);
Command walk_command(CLI::App& program);
Command plot_command(CLI::App& program);

}  // namespace gait::tool
