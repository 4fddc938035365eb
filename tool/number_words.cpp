#include "number_words.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

namespace gait::tool {

std::optional<double> number_said(std::string_view text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end || !std::isfinite(number)) return {};
  return number;
}

CLI::Validator seed_check() {
  return CLI::Validator(
      [](const std::string& seed) {
        std::uint64_t number = 0;
        const char* end = seed.data() + seed.size();
        const auto [stop, error] = std::from_chars(seed.data(), end, number);
        return error == std::errc() && stop == end
                   ? std::string()
                   : "expected a whole number from 0 to 2^64 - 1, found '" + seed + "'";
      },
      "");
}

}  // namespace gait::tool
