#include "speed_words.h"

#include <optional>
#include <sstream>

#include "commands.h"
#include "gait/numbers.h"

namespace gait::tool {

namespace {

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text + separator);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

}  // namespace

std::vector<double> parse_speeds(const std::string& text, char separator,
                                 const std::string& option) {
  std::vector<double> speeds;
  double unit = 1;  // m/s
  const std::vector<std::string> parts = parts_of(text, separator);
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    std::string_view said = *part;
    if (said.ends_with("km/h"))
      said.remove_suffix(4), unit = 1 / 3.6;
    else if (said.ends_with("m/s"))
      said.remove_suffix(3), unit = 1;
    while (said.ends_with(' ')) said.remove_suffix(1);
    const std::optional<double> speed = number_in(said);
    if (!speed)
      throw UsageError(option + " " + text + ": expected a speed in m/s or with the suffix km/h, " +
                       "found '" + *part + "'");
    speeds.insert(speeds.begin(), *speed * unit);
  }
  return speeds;
}

std::vector<double> parse_lengths(const std::string& text, const std::string& option) {
  std::vector<double> lengths;
  for (const std::string& part : parts_of(text, ',')) {
    const std::optional<double> length = number_in(part);
    if (!length || *length <= 0)
      throw UsageError(option + " " + text + ": expected a length in metres, found '" + part + "'");
    lengths.push_back(*length);
  }
  return lengths;
}

}  // namespace gait::tool
