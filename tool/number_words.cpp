#include "number_words.h"

#include <cstdint>
#include <string>

#include "gait/numbers.h"

namespace gait::tool {

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
