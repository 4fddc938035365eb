// Reads speeds and lengths on the command line: in m/s, or with the suffix km/h (or m/s), and in m.
#pragma once

#include <string>
#include <vector>

namespace gait::tool {

// Reads speeds that `separator` parts, "2,4,6km/h" as "0:1.4". A suffix holds for what stands
// before it without one. Throws UsageError that names `option` when one is no number.
std::vector<double> parse_speeds(const std::string& text, char separator,
                                 const std::string& option);

// Numbers without a unit to say, each above 0: "0.7,0.83".
std::vector<double> parse_lengths(const std::string& text, const std::string& option);

}  // namespace gait::tool
