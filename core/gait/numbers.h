// Numbers in text, read alike with every standard library. libc++ before version 20 has no
// std::from_chars for floating point, so those are read by fast_float (Lemire 2021).
#pragma once

#include <charconv>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string_view>

namespace gait {

// A decimal number at the beginning of a text: no white space before it, no '+'.
struct LeadingNumber {
  double value = 0;        // infinite when it is too large for a double, 0 when it is too small
  std::size_t length = 0;  // of its text, in characters; 0: the text begins with no number
};
LeadingNumber leading_number(std::string_view text) noexcept;

// The finite number that the whole text is; none when it is anything else.
std::optional<double> number_in(std::string_view text) noexcept;

// The same for whole numbers; none as well when the type cannot hold it.
template <std::integral Whole>
std::optional<Whole> whole_number_in(std::string_view text) noexcept {
  Whole value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace gait
