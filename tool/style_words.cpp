#include "style_words.h"

#include <optional>
#include <sstream>

#include "commands.h"
#include "gait/numbers.h"

namespace gait::tool {

std::vector<StyleShare> parse_mix(const std::string& text, const std::string& option) {
  std::vector<StyleShare> mix;
  if (text.find('=') == std::string::npos) return {{text, 1}};
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    const std::size_t equals = part.rfind('=');
    const std::optional<double> weight =
        equals == std::string::npos ? std::nullopt : number_in(part.substr(equals + 1));
    if (!weight || equals == 0)
      throw UsageError(option + " " + text + ": expected STYLE=WEIGHT, found '" + part + "'");
    mix.push_back({part.substr(0, equals), *weight});
  }
  return mix;
}

StyleChange parse_change(const std::string& text, const std::string& option) {
  const std::size_t at = text.rfind('@');
  const std::optional<double> seconds =
      at == std::string::npos ? std::nullopt : number_in(text.substr(at + 1));
  if (!seconds || *seconds < 0 || at == 0)
    throw UsageError(option + " " + text + ": expected STYLE@SECONDS");
  return {*seconds, parse_mix(text.substr(0, at), option)};
}

}  // namespace gait::tool
