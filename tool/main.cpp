// The command line program `gait`: what is done before the show. Exit codes: 0 done, 1 the work
// failed, 2 used wrongly; every error is one line on stderr.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "commands.h"
#include "gait/error.h"
#include "gait/names.h"

namespace {

using gait::tool::Command;

enum ExitCode { done = 0, failed = 1, used_wrongly = 2 };

// An exception's text may span lines; a user's terminal, log or script gets one.
void print_error(const std::string& who, std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::fprintf(stderr, "%s: %s\n", who.c_str(), message.c_str());
}

std::string names_of(const std::vector<Command>& commands) {
  return gait::joined_names(commands,
                            [](const Command& command) { return command.app->get_name(); });
}

int refuse(const CLI::App& program, const std::vector<Command>& commands, int argc, char** argv,
           const CLI::ParseError& error) {
  const auto chosen = program.get_subcommands();
  if (chosen.empty()) {
    const std::string first = argc > 1 ? argv[1] : "";
    if (first.empty())
      print_error("gait", "no subcommand given (" + names_of(commands) + "); see gait --help");
    else
      print_error("gait", "no " + std::string(first[0] == '-' ? "option" : "subcommand") + " '" +
                              first + "' (" + names_of(commands) + "); see gait --help");
    return used_wrongly;
  }
  const std::string who = "gait " + chosen.front()->get_name();
  const std::string hint = "; see " + who + " --help";
  // A mistyped option often makes another one look missing: name what was typed.
  for (const std::string& argument : program.remaining(true))
    if (argument.size() > 1 && argument[0] == '-') {
      print_error(who, "no option '" + argument + "'" + hint);
      return used_wrongly;
    }
  print_error(who, error.what() + hint);
  return used_wrongly;
}

int run(const Command& command) {
  const std::string who = "gait " + command.app->get_name();
  try {
    command.run();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw gait::Error("cannot write to standard output");
    return done;
  } catch (const gait::tool::UsageError& error) {
    print_error(who, std::string(error.what()) + "; see " + who + " --help");
    return used_wrongly;
  } catch (const std::bad_alloc&) {
    print_error(who, "not enough memory for this");
  } catch (const std::exception& error) {
    print_error(who, error.what());
  }
  return failed;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App program{
      "Recognise, reconstruct, synthesise and draw human walking: what is done before the show.",
      "gait"};
  program.set_version_flag("--version", "gait " GAIT_VERSION);
  program.set_help_flag("-h,--help", "What this program does");
  program.option_defaults()->always_capture_default();
  program.require_subcommand(1);

  using namespace gait::tool;
  std::vector<Command> commands;
  for (AddCommand* add :
       {corpus_command, roles_command, label_command, train_command, info_command, evaluate_command,
        reconstruct_command, synth_command, walk_command, render_command, plot_command,
#ifdef GAIT_HAS_OSC
        stream_command, listen_command
#endif
       })
    commands.push_back(add(program));
  for (const Command& command : commands)
    command.app->set_help_flag("-h,--help", "What this subcommand does");
  program.footer(
      "Each subcommand explains itself: gait SUBCOMMAND --help\n\n"
      "Exit codes: 0 done, 1 the work failed, 2 used wrongly.");

  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    return program.exit(wanted);
  } catch (const CLI::ParseError& error) {
    return refuse(program, commands, argc, argv, error);
  }
  for (const Command& command : commands)
    if (command.app->parsed()) return run(command);
  return used_wrongly;
} catch (const std::exception& error) {
  std::fprintf(stderr, "gait: %s\n", error.what());
  return failed;
}
