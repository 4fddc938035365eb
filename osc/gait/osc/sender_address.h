// Sender address: the host and port that a datagram came from, IPv4 and IPv6 alike.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace gait::osc {

struct SenderAddress {
  std::array<std::uint8_t, 16> host{};  // IPv6; an IPv4 address a.b.c.d as ::ffff:a.b.c.d
  std::uint16_t port = 0;

  bool operator==(const SenderAddress&) const = default;
  // "192.168.0.7:39540", "[::1]:39540"
  std::string name() const;
};

}  // namespace gait::osc
