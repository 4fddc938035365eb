#include "gait/osc/receiver.h"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "gait/error.h"
#include "gait/osc/packet.h"

namespace gait::osc {

namespace {

constexpr std::size_t largest_packet = 65536;
constexpr int kernel_buffer = 1 << 21;  // bytes, enough for a busy moment

int checked_port(int port) {
  if (port < 0 || port > 65535)
    throw Error("expected a port from 0 to 65535, got " + std::to_string(port));
  return port;
}

}  // namespace

Receiver::Receiver(const ReceiverSettings& settings)
    : reader_(settings.form),
      ring_(settings.capacity),
      socket_(checked_port(settings.port), settings.any, kernel_buffer),
      thread_([this] { run(); }) {}

Receiver::~Receiver() {
  waiter_.wake();
  thread_.join();
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
  while (waiter_.wait()) receive_all(buffer);
}

// Receives all waiting packets, but returns in time to see that the thread should end.
void Receiver::receive_all(std::span<std::byte> buffer) {
  for (int i = 0; i < 256; ++i) {
    UdpAddress from;
    const std::optional<std::size_t> count = socket_.receive(buffer, from);
    if (!count) return;
    arrival_.time = now();
    arrival_.sender = std::uint64_t{from.host} << 16 | from.port;
    packets_.fetch_add(1, std::memory_order_relaxed);
    const PacketContent content = open_packet(
        buffer.first(*count),
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
