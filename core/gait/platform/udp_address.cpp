#include "gait/platform/udp_address.h"

#include <algorithm>
#include <cstdio>

namespace gait {

bool UdpAddress::ipv4() const noexcept {
  return std::all_of(host.begin(), host.begin() + 10, [](auto x) { return x == 0; }) &&
         host[10] == 0xFF && host[11] == 0xFF;
}

std::string UdpAddress::name() const {
  char text[64];
  if (ipv4()) {
    std::snprintf(text, sizeof text, "%d.%d.%d.%d:%d", host[12], host[13], host[14], host[15],
                  port);
    return text;
  }
  // The longest run of zero groups is left out, as RFC 5952 asks.
  std::array<int, 8> groups;
  for (std::size_t i = 0; i < 8; ++i) groups[i] = host[2 * i] << 8 | host[2 * i + 1];
  std::size_t from = 8, length = 1;
  for (std::size_t i = 0; i < 8; ++i) {
    std::size_t end = i;
    while (end < 8 && groups[end] == 0) ++end;
    if (end - i > length) from = i, length = end - i;
  }
  std::string name = "[";
  for (std::size_t i = 0; i < 8; ++i) {
    if (i == from) {
      name += "::";
      i += length - 1;
      continue;
    }
    if (name.size() > 1 && name.back() != ':') name += ':';
    std::snprintf(text, sizeof text, "%x", groups[i]);
    name += text;
  }
  return name + "]:" + std::to_string(port);
}

}  // namespace gait
