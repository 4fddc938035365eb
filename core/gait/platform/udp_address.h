// UDP address: a host and a port, IPv4 and IPv6 alike.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace gait {

struct UdpAddress {
  std::array<std::uint8_t, 16> host{};  // IPv6; an IPv4 address a.b.c.d as ::ffff:a.b.c.d
  std::uint16_t port = 0;
  std::uint32_t zone = 0;  // the network that an IPv6 address of one network alone is in; 0: none

  bool ipv4() const noexcept;
  bool operator==(const UdpAddress&) const = default;
  // "192.168.0.7:39540", "[::1]:39540"
  std::string name() const;
};

}  // namespace gait
