// Destination: a UDP socket to a program on some machine.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "gait/platform/udp_socket.h"

namespace gait::osc {

class Destination {
 public:
  // Looks the host up, which may take seconds: not for Pd's thread. Throws Error when there is no
  // such host or port.
  Destination(const std::string& host, int port);

  // Sends one datagram. Never blocks. Returns false when the system refused it.
  bool send(std::span<const std::byte> bytes) const noexcept;
  const std::string& name() const noexcept { return name_; }  // "host:port"

 private:
  std::string name_;
  UdpAddress address_;
  UdpSocket socket_;
};

}  // namespace gait::osc
