// The subcommands of `gait`, one file each (command_NAME.cpp): a struct of options, a function that
// adds them to the command line, and one that does the work. make_command joins the three.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <stdexcept>

namespace gait::tool {

struct Command {
  CLI::App* app;              // the subcommand, owned by the program
  std::function<void()> run;  // throws Error when the work failed, UsageError when used wrongly
};

// The options were read but do not fit together: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Adds the subcommand `name` to the program. `add_options` binds the subcommand's options to the
// fields of an Options and sets the footer of its --help; `work` gets the options that were read.
template <typename Options>
Command make_command(CLI::App& program, const char* name, const char* purpose,
                     void (*add_options)(CLI::App&, Options&), void (*work)(const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App* app = program.add_subcommand(name, purpose);
  add_options(*app, *options);
  return {app, [options, work] { work(*options); }};
}

// Each adds one subcommand to the program.
using AddCommand = Command(CLI::App& program);
AddCommand corpus_command, roles_command, label_command, train_command, info_command,
    evaluate_command, reconstruct_command, synth_command, walk_command, render_command,
    plot_command;
AddCommand stream_command, listen_command;  // only in builds with liblo (GAIT_HAS_OSC)

}  // namespace gait::tool
