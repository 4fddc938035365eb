#include "gait/osc/sockets.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "gait/error.h"

namespace gait::osc {

namespace {

constexpr int kernel_buffer = 1 << 21;  // bytes, enough for a busy moment
constexpr int most_tries = 20;          // to find a port that is free in both families

NetworkAddress own_address(int family, int port, bool any) {
  NetworkAddress own;
  if (family == AF_INET) {
    auto& four = reinterpret_cast<sockaddr_in&>(own.address);
    four.sin_family = AF_INET;
    four.sin_port = htons(static_cast<std::uint16_t>(port));
    four.sin_addr.s_addr = htonl(any ? INADDR_ANY : INADDR_LOOPBACK);
    own.size = sizeof four;
  } else {
    auto& six = reinterpret_cast<sockaddr_in6&>(own.address);
    six.sin6_family = AF_INET6;
    six.sin6_port = htons(static_cast<std::uint16_t>(port));
    six.sin6_addr = any ? in6addr_any : in6addr_loopback;
    own.size = sizeof six;
  }
  return own;
}

int port_of(int opened) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  getsockname(opened, reinterpret_cast<sockaddr*>(&address), &size);
  return sender_of(address).port;
}

// The socket, or a negative error number.
int open_socket(int family, int port, bool any) {
  const int opened = socket(family, SOCK_DGRAM, 0);
  if (opened < 0) return -errno;
  setsockopt(opened, SOL_SOCKET, SO_RCVBUF, &kernel_buffer, sizeof kernel_buffer);
  const int yes = 1;  // IPv4 has a socket of its own
  if (family == AF_INET6) setsockopt(opened, IPPROTO_IPV6, IPV6_V6ONLY, &yes, sizeof yes);
  fcntl(opened, F_SETFL, O_NONBLOCK);
  fcntl(opened, F_SETFD, FD_CLOEXEC);
  const NetworkAddress own = own_address(family, port, any);
  if (bind(opened, reinterpret_cast<const sockaddr*>(&own.address), own.size) == 0) return opened;
  const int reason = errno;
  close(opened);
  return -reason;
}

[[noreturn]] void fail(int port, int reason) {
  const std::string name = "port " + std::to_string(port);
  if (reason == EADDRINUSE) throw Error(name + " is taken by another program");
  throw Error("cannot listen on " + name + ": " + std::strerror(reason));
}

}  // namespace

// liblo's own servers listen to every machine: these are bound to this one alone, unless asked.
ListeningSockets::ListeningSockets(int port, bool any) {
  for (int tries = 0;; ++tries) {
    const int four = open_socket(AF_INET, port, any);
    if (four >= 0) sockets_.push_back(four);
    port_ = four >= 0 ? port_of(four) : port;
    const int six = open_socket(AF_INET6, port_, any);
    if (six >= 0) sockets_.push_back(six);
    if (four < 0 && six >= 0) port_ = port_of(six);
    // A machine may have one family alone. A port that is taken in one is taken.
    const int reason = four == -EADDRINUSE || six == -EADDRINUSE ? EADDRINUSE
                       : sockets_.empty()                        ? -four
                                                                 : 0;
    if (reason == 0) return;
    close_all();
    if (port != 0 || reason != EADDRINUSE || tries == most_tries) fail(port, reason);
  }
}

ListeningSockets::~ListeningSockets() { close_all(); }

void ListeningSockets::close_all() noexcept {
  for (const int opened : sockets_) close(opened);
  sockets_.clear();
}

SenderAddress sender_of(const sockaddr_storage& from) noexcept {
  SenderAddress sender;
  if (from.ss_family == AF_INET) {
    const auto& four = reinterpret_cast<const sockaddr_in&>(from);
    sender.host[10] = sender.host[11] = 0xFF;
    std::memcpy(sender.host.data() + 12, &four.sin_addr, 4);
    sender.port = ntohs(four.sin_port);
  } else if (from.ss_family == AF_INET6) {
    const auto& six = reinterpret_cast<const sockaddr_in6&>(from);
    std::memcpy(sender.host.data(), &six.sin6_addr, 16);
    sender.port = ntohs(six.sin6_port);
  }
  return sender;
}

std::vector<NetworkAddress> addresses_of(const std::string& host, int port,
                                         const std::string& name) {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int result = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found);
  std::vector<NetworkAddress> addresses;
  for (const addrinfo* at = found; result == 0 && at; at = at->ai_next) {
    if (at->ai_family != AF_INET && at->ai_family != AF_INET6) continue;
    NetworkAddress& address = addresses.emplace_back();
    address.size = at->ai_addrlen;
    std::memcpy(&address.address, at->ai_addr, at->ai_addrlen);
  }
  if (result == 0) freeaddrinfo(found);
  if (addresses.empty())
    throw Error(name + ": no host of that name is found (" + gai_strerror(result) + ")");
  return addresses;
}

}  // namespace gait::osc
