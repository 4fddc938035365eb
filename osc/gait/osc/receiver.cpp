#include "gait/osc/receiver.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <vector>

#include "gait/error.h"
#include "gait/osc/packet.h"

namespace gait::osc {

namespace {

constexpr std::size_t largest_packet = 65536;
constexpr int kernel_buffer = 1 << 21;  // bytes, enough for a busy moment

// liblo's own servers listen to every machine: this socket is bound to this one alone.
int open_socket(const ReceiverSettings& settings) {
  const int opened = socket(AF_INET, SOCK_DGRAM, 0);
  if (opened < 0) throw Error(std::string("cannot open a socket: ") + std::strerror(errno));
  setsockopt(opened, SOL_SOCKET, SO_RCVBUF, &kernel_buffer, sizeof kernel_buffer);
  fcntl(opened, F_SETFL, O_NONBLOCK);
  fcntl(opened, F_SETFD, FD_CLOEXEC);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(settings.port));
  address.sin_addr.s_addr = htonl(settings.any ? INADDR_ANY : INADDR_LOOPBACK);
  if (bind(opened, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return opened;
  const int reason = errno;
  close(opened);
  const std::string port = "port " + std::to_string(settings.port);
  if (reason == EADDRINUSE) throw Error(port + " is taken by another program");
  throw Error("cannot listen on " + port + ": " + std::strerror(reason));
}

int port_of(int opened) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getsockname(opened, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

}  // namespace

Receiver::Receiver(const ReceiverSettings& settings)
    : reader_(settings.form), ring_(settings.capacity) {
  if (settings.port < 0 || settings.port > 65535)
    throw Error("expected a port from 0 to 65535, got " + std::to_string(settings.port));
  socket_ = open_socket(settings);
  port_ = port_of(socket_);
  // Programs that Pd starts must not inherit the socket.
  if (pipe2(wake_, O_CLOEXEC) != 0) {
    close(socket_);
    throw Error(std::string("cannot open a pipe: ") + std::strerror(errno));
  }
  thread_ = std::thread([this] { run(); });
}

Receiver::~Receiver() {
  const char end = 0;
  while (write(wake_[1], &end, 1) < 0 && errno == EINTR) continue;
  thread_.join();
  close(wake_[1]);
  close(wake_[0]);
  close(socket_);
}

double Receiver::now() noexcept {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Received Receiver::received() const noexcept {
  return {packets_.load(std::memory_order_relaxed), messages_.load(std::memory_order_relaxed),
          unknown_.load(std::memory_order_relaxed), faulty_.load(std::memory_order_relaxed),
          dropped_.load(std::memory_order_relaxed)};
}

void Receiver::run() {
  std::vector<std::byte> buffer(largest_packet);
  pollfd watched[2] = {{socket_, POLLIN, 0}, {wake_[0], POLLIN, 0}};
  while (true) {
    if (poll(watched, 2, -1) < 0 && errno != EINTR) return;
    if (watched[1].revents != 0) return;
    if (watched[0].revents != 0) receive_all(buffer);
  }
}

// Receives all waiting packets, but returns in time to see that the thread should end.
void Receiver::receive_all(std::span<std::byte> buffer) {
  for (int i = 0; i < 256; ++i) {
    sockaddr_in from{};
    socklen_t size = sizeof from;
    const ssize_t count = recvfrom(socket_, buffer.data(), buffer.size(), 0,
                                   reinterpret_cast<sockaddr*>(&from), &size);
    if (count < 0) return;
    arrival_.time = now();
    arrival_.sender = std::uint64_t{ntohl(from.sin_addr.s_addr)} << 16 | ntohs(from.sin_port);
    packets_.fetch_add(1, std::memory_order_relaxed);
    const PacketContent content = open_packet(
        buffer.first(static_cast<std::size_t>(count)),
        [](void* self, const OscMessage& message) {
          static_cast<Receiver*>(self)->take_message(message);
        },
        this);
    faulty_.fetch_add(static_cast<std::uint64_t>(content.faulty), std::memory_order_relaxed);
  }
}

void Receiver::take_message(const OscMessage& message) {
  messages_.fetch_add(1, std::memory_order_relaxed);
  switch (reader_.read(message, arrival_, *this)) {
    case Reading::taken:
      break;
    case Reading::unknown:
      unknown_.fetch_add(1, std::memory_order_relaxed);
      break;
    case Reading::faulty:
      faulty_.fetch_add(1, std::memory_order_relaxed);
      break;
  }
}

void Receiver::take(const MocapEvent& event) {
  if (!ring_.push(event)) dropped_.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace gait::osc
