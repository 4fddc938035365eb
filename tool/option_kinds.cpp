#include "option_kinds.h"

#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "gait/numbers.h"

namespace gait::tool {

void add_model_argument(CLI::App& app, std::string& model) {
  add_argument(app, "MODEL", model, "Model file, or gait-demo: the one that is built in");
}

void add_output(CLI::App& app, const char* type, std::string& path, const std::string& help) {
  add_value(app, "-o,--output", type, path, help)->required();
}

void add_choice(CLI::App& app, const char* name, const std::vector<std::string>& words,
                std::string& choice, const std::string& help) {
  const std::string type = CLI::detail::join(words, "|");
  add_value(app, name, type.c_str(), choice, help)->check(one_of(words));
}

void add_json_flag(CLI::App& app, bool& json, const std::string& help) {
  app.add_flag("--json", json, help);
}

CLI::Validator within(double least, double most) {
  return CLI::Validator(
      [least, most](const std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        if (end != text.c_str() && *end == '\0' && value >= least && value <= most)
          return std::string();
        std::ostringstream fault;
        fault << "expected a number from " << least << " to " << most << ", found '" << text << "'";
        return fault.str();
      },
      "");
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  return CLI::IsMember(words).description("");
}

CLI::Validator seed_check() {
  return CLI::Validator(
      [](const std::string& seed) {
        return whole_number_in<std::uint64_t>(seed)
                   ? std::string()
                   : "expected a whole number from 0 to 2^64 - 1, found '" + seed + "'";
      },
      "");
}

}  // namespace gait::tool
