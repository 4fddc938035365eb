#include "gait/osc/receiver.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
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
constexpr std::size_t most_unknown = 6;  // addresses to remember
const ReceiverSettings& checked(const ReceiverSettings& settings) {
  if (settings.port < 0 || settings.port > 65535)
    throw Error("expected a port from 0 to 65535, got " + std::to_string(settings.port));
  return settings;
}

}  // namespace

Receiver::Receiver(const ReceiverSettings& settings)
    : reader_(settings.form),
      ring_(settings.capacity),
      sockets_(checked(settings).port, settings.any) {
  // Programs that Pd starts must not inherit it.
  if (pipe2(wake_, O_CLOEXEC) != 0)
    throw Error(std::string("cannot open a pipe: ") + std::strerror(errno));
  thread_ = std::thread([this] { run(); });
}

Receiver::~Receiver() {
  const char end = 0;
  while (write(wake_[1], &end, 1) < 0 && errno == EINTR) continue;
  thread_.join();
  close(wake_[1]);
  close(wake_[0]);
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
  std::vector<pollfd> watched{{wake_[0], POLLIN, 0}};
  for (const int opened : sockets_.sockets()) watched.push_back({opened, POLLIN, 0});
  while (true) {
    if (poll(watched.data(), watched.size(), -1) < 0 && errno != EINTR) return;
    if (watched[0].revents != 0) return;
    for (std::size_t i = 1; i < watched.size(); ++i)
      if (watched[i].revents != 0) receive_all(watched[i].fd, buffer);
  }
}

// Receives all waiting packets, but returns in time to see that the thread should end.
void Receiver::receive_all(int socket, std::span<std::byte> buffer) {
  for (int i = 0; i < 256; ++i) {
    sockaddr_storage from{};
    socklen_t size = sizeof from;
    const ssize_t count = recvfrom(socket, buffer.data(), buffer.size(), 0,
                                   reinterpret_cast<sockaddr*>(&from), &size);
    if (count < 0) return;
    arrival_.time = now();
    arrival_.sender = sender_of(from);
    packets_.fetch_add(1, std::memory_order_relaxed);
    take_packet(buffer.first(static_cast<std::size_t>(count)));
  }
}

void Receiver::take_packet(std::span<const std::byte> packet) {
  if (!is_osc(packet)) {
    const Reading reading = reader_.read(packet, arrival_, *this);
    messages_.fetch_add(reading == Reading::unknown ? 0 : 1, std::memory_order_relaxed);
    count(reading == Reading::unknown ? Reading::faulty : reading);
    return;
  }
  const PacketContent content = open_packet(
      packet,
      [](void* self, const OscMessage& message) {
        auto& receiver = *static_cast<Receiver*>(self);
        receiver.messages_.fetch_add(1, std::memory_order_relaxed);
        const Reading reading = receiver.reader_.read(message, receiver.arrival_, receiver);
        receiver.count(reading);
        if (reading == Reading::unknown) receiver.remember(message.path());
      },
      this);
  faulty_.fetch_add(static_cast<std::uint64_t>(content.faulty), std::memory_order_relaxed);
}

void Receiver::count(Reading reading) {
  if (reading == Reading::unknown) unknown_.fetch_add(1, std::memory_order_relaxed);
  if (reading == Reading::faulty) faulty_.fetch_add(1, std::memory_order_relaxed);
}

void Receiver::remember(std::string_view address) {
  const std::lock_guard lock(unknown_mutex_);
  if (unknown_addresses_.size() == most_unknown ||
      std::ranges::find(unknown_addresses_, address) != unknown_addresses_.end())
    return;
  unknown_addresses_.emplace_back(address.substr(0, 80));
}

std::string Receiver::unknown_addresses() const {
  const std::lock_guard lock(unknown_mutex_);
  std::string text;
  for (const std::string& address : unknown_addresses_)
    text += (text.empty() ? ": " : ", ") + address;
  return text;
}

std::string_view Receiver::notice() const noexcept {
  switch (notice_.load(std::memory_order_relaxed)) {
    case Notice::rokoko_compressed:
      return "Rokoko Studio sends a compressed stream: in its Custom Streaming choose the format "
             "'JSON v3', not a compressed one (LZ4)";
    case Notice::none:
      break;
  }
  return {};
}

void Receiver::take(const MocapEvent& event) {
  if (event.kind == MocapKind::notice) {
    notice_.store(static_cast<Notice>(event.first), std::memory_order_relaxed);
    return;
  }
  if (!ring_.push(event)) dropped_.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace gait::osc
