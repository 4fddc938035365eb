#include "gait/platform/udp_socket.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "gait/error.h"

namespace gait {

namespace {

constexpr int most_tries = 20;  // to find a port that is free in both families
constexpr std::array<int, 2> families{AF_INET, AF_INET6};

int descriptor(std::intptr_t socket) { return static_cast<int>(socket); }

std::string reason_of(int error) { return std::generic_category().message(error); }

struct SystemAddress {
  sockaddr_storage storage{};
  socklen_t size = sizeof storage;

  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
};

SystemAddress system_address(const UdpAddress& address) {
  SystemAddress result;
  if (address.ipv4()) {
    auto& four = reinterpret_cast<sockaddr_in&>(result.storage);
    four.sin_family = AF_INET;
    four.sin_port = htons(address.port);
    std::memcpy(&four.sin_addr, address.host.data() + 12, 4);
    result.size = sizeof four;
  } else {
    auto& six = reinterpret_cast<sockaddr_in6&>(result.storage);
    six.sin6_family = AF_INET6;
    six.sin6_port = htons(address.port);
    std::memcpy(&six.sin6_addr, address.host.data(), 16);
    six.sin6_scope_id = address.zone;
    result.size = sizeof six;
  }
  return result;
}

UdpAddress udp_address(const sockaddr_storage& storage) {
  UdpAddress result;
  if (storage.ss_family == AF_INET) {
    const auto& four = reinterpret_cast<const sockaddr_in&>(storage);
    result.host[10] = result.host[11] = 0xFF;
    std::memcpy(result.host.data() + 12, &four.sin_addr, 4);
    result.port = ntohs(four.sin_port);
  } else if (storage.ss_family == AF_INET6) {
    const auto& six = reinterpret_cast<const sockaddr_in6&>(storage);
    std::memcpy(result.host.data(), &six.sin6_addr, 16);
    result.port = ntohs(six.sin6_port);
    result.zone = six.sin6_scope_id;
  }
  return result;
}

UdpAddress own_address(int family, int port, bool any) {
  UdpAddress result;
  result.port = static_cast<std::uint16_t>(port);
  if (family == AF_INET) {
    result.host[10] = result.host[11] = 0xFF;
    if (!any) result.host[12] = 127, result.host[15] = 1;
  } else if (!any) {
    result.host[15] = 1;
  }
  return result;
}

// The socket, or a negative error number.
int open_udp(int family) {
  const int opened = socket(family, SOCK_DGRAM, 0);
  if (opened < 0) return -errno;
  fcntl(opened, F_SETFL, O_NONBLOCK);
  fcntl(opened, F_SETFD, FD_CLOEXEC);
  return opened;
}

int open_to_listen(int family, int port, bool any, int buffer) {
  const int opened = open_udp(family);
  if (opened < 0) return opened;
  setsockopt(opened, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer);
  const int yes = 1;  // IPv4 has a socket of its own
  if (family == AF_INET6) setsockopt(opened, IPPROTO_IPV6, IPV6_V6ONLY, &yes, sizeof yes);
  SystemAddress own = system_address(own_address(family, port, any));
  if (bind(opened, own.get(), own.size) == 0) return opened;
  const int reason = errno;
  close(opened);
  return -reason;
}

int port_of(int opened) {
  SystemAddress address;
  getsockname(opened, address.get(), &address.size);
  return udp_address(address.storage).port;
}

// A connected socket learns when an address refuses packets. Fails while there is no network.
bool connect_to(int opened, const UdpAddress& to) {
  SystemAddress address = system_address(to);
  return connect(opened, address.get(), address.size) == 0;
}

}  // namespace

std::vector<UdpAddress> addresses_of(const std::string& host, int port, const std::string& name) {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int result = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found);
  const std::string reason =
      result == EAI_SYSTEM ? reason_of(errno) : std::string(gai_strerror(result));
  std::vector<UdpAddress> addresses;
  for (const addrinfo* at = found; result == 0 && at; at = at->ai_next) {
    if (at->ai_family != AF_INET && at->ai_family != AF_INET6) continue;
    sockaddr_storage storage{};
    std::memcpy(&storage, at->ai_addr, at->ai_addrlen);
    addresses.push_back(udp_address(storage));
  }
  if (result == 0) freeaddrinfo(found);
  if (addresses.empty()) throw Error(name + ": no host of that name is found (" + reason + ")");
  return addresses;
}

UdpSender::UdpSender(const UdpAddress& to)
    : to_(to), socket_(open_udp(to.ipv4() ? AF_INET : AF_INET6)) {
  const int opened = descriptor(socket_);
  if (opened < 0) throw Error("cannot open a socket: " + reason_of(-opened));
  const int yes = 1;  // allows broadcast: x.x.x.255
  setsockopt(opened, SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes);
  connect_to(opened, to_);
}

UdpSender::~UdpSender() { close(descriptor(socket_)); }

Sent UdpSender::send(std::span<const std::byte> bytes) const noexcept {
  const int opened = descriptor(socket_);
  const auto sent = [&] {
    return ::send(opened, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
  };
  if (sent()) return Sent::yes;
  if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EMSGSIZE) return Sent::no;
  if (errno == ECONNREFUSED) return Sent::refused;
  // The network may have changed since.
  return connect_to(opened, to_) && sent() ? Sent::yes : Sent::unreachable;
}

UdpListener::UdpListener(int port, bool any, int buffer) {
  for (int tries = 0;; ++tries) {
    port_ = port;
    bool taken = false;
    int reason = 0;
    for (std::size_t i = 0; i < families.size(); ++i) {
      const int opened = open_to_listen(families[i], port_, any, buffer);
      if (opened < 0) {
        taken = taken || opened == -EADDRINUSE;
        if (reason == 0) reason = -opened;
        continue;
      }
      sockets_[i] = opened;
      if (port_ == 0) port_ = port_of(opened);
    }
    // A machine may have one family alone. A port that is taken in one is taken.
    if (!taken && (sockets_[0] >= 0 || sockets_[1] >= 0)) return;
    close_all();
    if (port == 0 && taken && tries < most_tries) continue;
    const std::string name = "port " + std::to_string(port);
    if (taken) throw Error(name + " is taken by another program");
    throw Error("cannot listen on " + name + ": " + reason_of(reason));
  }
}

UdpListener::~UdpListener() { close_all(); }

void UdpListener::close_all() noexcept {
  for (std::intptr_t& opened : sockets_) {
    if (opened >= 0) close(descriptor(opened));
    opened = -1;
  }
}

std::optional<std::size_t> UdpListener::receive(std::span<std::byte> buffer,
                                                UdpAddress& from) noexcept {
  for (std::size_t tries = 0; tries < sockets_.size(); ++tries) {
    const std::intptr_t opened = sockets_[next_];
    next_ = (next_ + 1) % sockets_.size();
    if (opened < 0) continue;
    SystemAddress address;
    const ssize_t count =
        recvfrom(descriptor(opened), buffer.data(), buffer.size(), 0, address.get(), &address.size);
    if (count < 0) continue;
    from = udp_address(address.storage);
    return static_cast<std::size_t>(count);
  }
  return std::nullopt;
}

PacketWaiter::PacketWaiter(const UdpListener& listener) : listener_(listener) {
  int ends[2];
  if (pipe(ends) != 0) throw Error("cannot open a pipe: " + reason_of(errno));
  for (const int end : ends) fcntl(end, F_SETFD, FD_CLOEXEC);
  woken_ = ends[0];
  waking_ = ends[1];
}

PacketWaiter::~PacketWaiter() {
  close(descriptor(waking_));
  close(descriptor(woken_));
}

bool PacketWaiter::wait() noexcept {
  pollfd watched[3] = {{descriptor(listener_.sockets_[0]), POLLIN, 0},  // below 0: not watched
                       {descriptor(listener_.sockets_[1]), POLLIN, 0},
                       {descriptor(woken_), POLLIN, 0}};
  while (poll(watched, 3, -1) < 0)
    if (errno != EINTR) return false;
  return watched[2].revents == 0;
}

void PacketWaiter::wake() noexcept {
  const char end = 0;
  while (write(descriptor(waking_), &end, 1) < 0 && errno == EINTR) continue;
}

}  // namespace gait
