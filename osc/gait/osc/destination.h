// Destination: a UDP socket to a program on some machine.
#pragma once

#include <netinet/in.h>

#include <cstddef>
#include <span>
#include <string>

namespace gait::osc {

class Destination {
 public:
  // Looks the host up, which may take seconds: not for Pd's thread. Throws Error when there is no
  // such host or port.
  Destination(const std::string& host, int port);
  ~Destination();
  Destination(const Destination&) = delete;
  Destination& operator=(const Destination&) = delete;

  // Sends one datagram. Never blocks. Returns false when the system refused it.
  bool send(std::span<const std::byte> bytes) const noexcept;
  const std::string& name() const noexcept { return name_; }  // "host:port"

 private:
  std::string name_;
  sockaddr_in address_{};
  int socket_ = -1;
};

}  // namespace gait::osc
