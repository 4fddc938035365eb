#include "gait/platform/udp_socket.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "gait/error.h"

namespace gait {

namespace {

int descriptor(std::intptr_t socket) { return static_cast<int>(socket); }

std::string reason_of(int error) { return std::generic_category().message(error); }

sockaddr_in ipv4(UdpAddress address) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_addr.s_addr = htonl(address.host);
  result.sin_port = htons(address.port);
  return result;
}

int open_udp() {
  const int opened = socket(AF_INET, SOCK_DGRAM, 0);
  if (opened < 0) throw Error("cannot open a socket: " + reason_of(errno));
  fcntl(opened, F_SETFL, O_NONBLOCK);
  fcntl(opened, F_SETFD, FD_CLOEXEC);
  return opened;
}

}  // namespace

std::uint32_t find_host(const std::string& name) {
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int result = getaddrinfo(name.c_str(), nullptr, &wanted, &found);
  if (result != 0 || found == nullptr)
    throw Error("no host of that name is found (" +
                (result == EAI_SYSTEM ? reason_of(errno) : std::string(gai_strerror(result))) +
                ")");
  const std::uint32_t host =
      ntohl(reinterpret_cast<const sockaddr_in*>(found->ai_addr)->sin_addr.s_addr);
  freeaddrinfo(found);
  return host;
}

UdpSocket::UdpSocket() : socket_(open_udp()) {
  const int yes = 1;
  setsockopt(descriptor(socket_), SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes);
}

UdpSocket::UdpSocket(int port, bool any, int buffer) : socket_(open_udp()) {
  const int opened = descriptor(socket_);
  setsockopt(opened, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer);
  const sockaddr_in address =
      ipv4({any ? INADDR_ANY : INADDR_LOOPBACK, static_cast<std::uint16_t>(port)});
  if (bind(opened, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return;
  const int reason = errno;
  close(opened);
  const std::string name = "port " + std::to_string(port);
  if (reason == EADDRINUSE) throw Error(name + " is taken by another program");
  throw Error("cannot listen on " + name + ": " + reason_of(reason));
}

UdpSocket::~UdpSocket() { close(descriptor(socket_)); }

int UdpSocket::port() const {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getsockname(descriptor(socket_), reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

bool UdpSocket::send(std::span<const std::byte> bytes, UdpAddress to) const noexcept {
  const sockaddr_in address = ipv4(to);
  return sendto(descriptor(socket_), bytes.data(), bytes.size(), 0,
                reinterpret_cast<const sockaddr*>(&address),
                sizeof address) == static_cast<ssize_t>(bytes.size());
}

std::optional<std::size_t> UdpSocket::receive(std::span<std::byte> buffer,
                                              UdpAddress& from) const noexcept {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  const ssize_t count = recvfrom(descriptor(socket_), buffer.data(), buffer.size(), 0,
                                 reinterpret_cast<sockaddr*>(&address), &size);
  if (count < 0) return std::nullopt;
  from = {ntohl(address.sin_addr.s_addr), ntohs(address.sin_port)};
  return static_cast<std::size_t>(count);
}

PacketWaiter::PacketWaiter(const UdpSocket& socket) : socket_(socket) {
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
  pollfd watched[2] = {{descriptor(socket_.socket_), POLLIN, 0}, {descriptor(woken_), POLLIN, 0}};
  while (poll(watched, 2, -1) < 0)
    if (errno != EINTR) return false;
  return watched[1].revents == 0;
}

void PacketWaiter::wake() noexcept {
  const char end = 0;
  while (write(descriptor(waking_), &end, 1) < 0 && errno == EINTR) continue;
}

}  // namespace gait
