#include "gait/numbers.h"

#include <fast_float/fast_float.h>

#include <cmath>

namespace gait {

LeadingNumber leading_number(std::string_view text) noexcept {
  LeadingNumber number;
  const auto read = fast_float::from_chars(text.data(), text.data() + text.size(), number.value);
  // Newer versions call a number out of range an error, and give the value and the end all the
  // same.
  if (read.ec == std::errc{} || read.ec == std::errc::result_out_of_range)
    number.length = static_cast<std::size_t>(read.ptr - text.data());
  return number;
}

std::optional<double> number_in(std::string_view text) noexcept {
  const LeadingNumber number = leading_number(text);
  if (text.empty() || number.length != text.size() || !std::isfinite(number.value))
    return std::nullopt;
  return number.value;
}

}  // namespace gait
