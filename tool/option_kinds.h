// The kinds of options that the subcommands share, and the checks of their values.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gait::tool {

// An option `name` that takes one value; --help shows `type` behind the name.
template <typename Value>
CLI::Option* add_value(CLI::App& app, const char* name, const char* type, Value& value,
                       const std::string& help) {
  return app.add_option(name, value, help)->type_name(type);
}

// A positional argument that must be given, once or, for a vector, several times.
template <typename Value>
CLI::Option* add_argument(CLI::App& app, const char* name, Value& value, const std::string& help) {
  return add_value(app, name, "", value, help)->required()->default_str("");
}

// MODEL: a file, or a name that model_named knows.
void add_model_argument(CLI::App& app, std::string& model);

// -o, --output, which must be given.
void add_output(CLI::App& app, const char* type, std::string& path, const std::string& help);

// One of `words`; --help shows them as the type.
void add_choice(CLI::App& app, const char* name, const std::vector<std::string>& words,
                std::string& choice, const std::string& help);

void add_json_flag(CLI::App& app, bool& json, const std::string& help = "Report as JSON");

// Comma-separated values in one argument, so that what follows may be a positional argument.
template <typename Value>
CLI::Option* add_list(CLI::App& app, const char* name, const char* type, Value& values,
                      const std::string& help) {
  return add_value(app, name, type, values, help)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->default_str("");
}

// Checks that a value is a number of this range. Refuses NaN, which CLI::Range accepts.
CLI::Validator within(double least, double most);

// Checks that a value is one of `words`, without a word in --help.
CLI::Validator one_of(const std::vector<std::string>& words);

// Checks a seed, a whole number of 64 bits: CLI11 would read "-3" as a very large number.
CLI::Validator seed_check();

}  // namespace gait::tool
