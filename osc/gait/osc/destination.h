// Destination: UDP to a program on some machine.
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <span>
#include <string>

#include "gait/platform/udp_socket.h"

namespace gait::osc {

class Destination {
 public:
  // Looks the host up, which may take seconds: not for Pd's thread. A name may have several
  // addresses, as `localhost` has 127.0.0.1 and ::1: packets go to the first one that does not
  // refuse them. Throws Error when there is no such host or port.
  Destination(const std::string& host, int port);

  // Sends one datagram. Never blocks. Returns false when the system refused it; a program that does
  // not listen yet is no reason.
  bool send(std::span<const std::byte> bytes) const noexcept;
  const std::string& name() const noexcept { return name_; }  // "host:port"

 private:
  std::string name_;
  std::deque<UdpSender> ways_;  // one for each address
  mutable std::atomic<std::size_t> current_{0};
};

}  // namespace gait::osc
