// Sockets: UDP on this machine's addresses of both families, IPv4 and IPv6. The only place that
// names families.
#pragma once

#include <sys/socket.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gait/osc/sender_address.h"

namespace gait::osc {

// A socket of each family that this machine has, on one port; closed at the end. `port` 0: any
// free one. Throws Error when the port is taken or not allowed.
class ListeningSockets {
 public:
  ListeningSockets(int port, bool any);
  ~ListeningSockets();
  ListeningSockets(const ListeningSockets&) = delete;
  ListeningSockets& operator=(const ListeningSockets&) = delete;

  const std::vector<int>& sockets() const noexcept { return sockets_; }
  int port() const noexcept { return port_; }

 private:
  void close_all() noexcept;

  std::vector<int> sockets_;
  int port_ = 0;
};

SenderAddress sender_of(const sockaddr_storage& from) noexcept;

struct NetworkAddress {
  sockaddr_storage address{};
  socklen_t size = 0;
};
// All addresses of a host, in the order in which the system prefers them. May take seconds. Throws
// Error, whose text begins with `name`, when there is no such host.
std::vector<NetworkAddress> addresses_of(const std::string& host, int port,
                                         const std::string& name);

}  // namespace gait::osc
