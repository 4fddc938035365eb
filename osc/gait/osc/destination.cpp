#include "gait/osc/destination.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "gait/error.h"
#include "gait/osc/sockets.h"

namespace gait::osc {

namespace {

// A connected socket learns when an address refuses packets. Fails while there is no network.
bool connect_to(int opened, const NetworkAddress& to) noexcept {
  return connect(opened, reinterpret_cast<const sockaddr*>(&to.address), to.size) == 0;
}

}  // namespace

Destination::Destination(const std::string& host, int port)
    : name_((host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" +
            std::to_string(port)) {
  if (port < 1 || port > 65535)
    throw Error(name_ + ": expected a port from 1 to 65535, got " + std::to_string(port));
  int reason = 0;
  for (const NetworkAddress& to : addresses_of(host, port, name_)) {
    const int opened = socket(to.address.ss_family, SOCK_DGRAM, 0);
    if (opened < 0) {
      reason = errno;
      continue;
    }
    fcntl(opened, F_SETFL, O_NONBLOCK);
    fcntl(opened, F_SETFD, FD_CLOEXEC);
    const int yes = 1;  // allows broadcast: x.x.x.255
    setsockopt(opened, SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes);
    connect_to(opened, to);
    ways_.push_back({opened, to});
  }
  if (ways_.empty()) throw Error(name_ + ": cannot open a socket: " + std::strerror(reason));
}

Destination::~Destination() {
  for (const Way& way : ways_) close(way.socket);
}

bool Destination::send(std::span<const std::byte> bytes) const noexcept {
  bool refused = false;
  for (std::size_t tries = 0; tries < 2 * ways_.size(); ++tries) {
    const std::size_t at = current_.load(std::memory_order_relaxed) % ways_.size();
    const Way& way = ways_[at];
    const auto sent = [&] {
      return ::send(way.socket, bytes.data(), bytes.size(), 0) ==
             static_cast<ssize_t>(bytes.size());
    };
    if (sent()) return true;
    if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EMSGSIZE) return false;
    // An earlier packet's refusal is said at this one: it then goes to the next address. After any
    // other failure the network may have changed since.
    if (errno == ECONNREFUSED)
      refused = true;
    else if (connect_to(way.socket, way.to) && sent())
      return true;
    current_.store(at + 1, std::memory_order_relaxed);
  }
  return refused;
}

}  // namespace gait::osc
