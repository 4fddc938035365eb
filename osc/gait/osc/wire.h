// Wire: numbers in datagrams of either byte order.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace gait::osc {

// `order` of the bytes on the wire. The caller has checked that they are there.
template <typename T, std::endian order>
T number_at(std::span<const std::byte> bytes, std::size_t at) noexcept {
  using Bits = std::conditional_t<
      sizeof(T) == 8, std::uint64_t,
      std::conditional_t<sizeof(T) == 4, std::uint32_t,
                         std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;
  Bits bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    const std::size_t from = order == std::endian::big ? i : sizeof(T) - 1 - i;
    bits = static_cast<Bits>(sizeof(T) == 1 ? 0 : bits << 8) |
           static_cast<Bits>(std::to_integer<std::uint8_t>(bytes[at + from]));
  }
  return std::bit_cast<T>(bits);
}

template <std::endian order, typename T>
void put_number(std::span<std::byte> bytes, std::size_t at, T value) noexcept {
  using Bits = std::conditional_t<
      sizeof(T) == 8, std::uint64_t,
      std::conditional_t<sizeof(T) == 4, std::uint32_t,
                         std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;
  const auto bits = static_cast<std::uint64_t>(std::bit_cast<Bits>(value));
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    const std::size_t shift = 8 * (order == std::endian::big ? sizeof(T) - 1 - i : i);
    bytes[at + i] = static_cast<std::byte>(bits >> shift & 0xFF);
  }
}

}  // namespace gait::osc
