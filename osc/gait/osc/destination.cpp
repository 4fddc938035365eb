#include "gait/osc/destination.h"

#include <fcntl.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "gait/error.h"

namespace gait::osc {

Destination::Destination(const std::string& host, int port)
    : name_(host + ":" + std::to_string(port)) {
  if (port < 1 || port > 65535)
    throw Error(name_ + ": expected a port from 1 to 65535, got " + std::to_string(port));
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int result = getaddrinfo(host.c_str(), nullptr, &wanted, &found);
  if (result != 0 || !found)
    throw Error(name_ + ": no host of that name is found (" + gai_strerror(result) + ")");
  std::memcpy(&address_, found->ai_addr, sizeof address_);
  freeaddrinfo(found);
  address_.sin_port = htons(static_cast<std::uint16_t>(port));
  socket_ = socket(AF_INET, SOCK_DGRAM, 0);
  if (socket_ < 0) throw Error(name_ + ": cannot open a socket: " + std::strerror(errno));
  fcntl(socket_, F_SETFL, O_NONBLOCK);
  fcntl(socket_, F_SETFD, FD_CLOEXEC);
  const int yes = 1;  // allows broadcast: x.x.x.255
  setsockopt(socket_, SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes);
}

Destination::~Destination() {
  if (socket_ >= 0) close(socket_);
}

bool Destination::send(std::span<const std::byte> bytes) const noexcept {
  return sendto(socket_, bytes.data(), bytes.size(), 0,
                reinterpret_cast<const sockaddr*>(&address_),
                sizeof address_) == static_cast<ssize_t>(bytes.size());
}

}  // namespace gait::osc
