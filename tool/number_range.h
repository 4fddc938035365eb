// A check of numbers on the command line that NaN does not pass, as it does CLI::Range.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <sstream>
#include <string>

namespace gait::tool {

inline CLI::Validator within(double least, double most) {
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

}  // namespace gait::tool
