#include "gait/osc/receiver.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "gait/error.h"
#include "gait/osc/packet.h"

namespace gait::osc {

namespace {

constexpr std::size_t largest_packet = 65536;
constexpr int kernel_buffer = 1 << 21;   // bytes, enough for a busy moment
constexpr std::size_t most_unknown = 6;  // addresses to remember

int checked_port(int port) {
  if (port < 0 || port > 65535)
    throw Error("expected a port from 0 to 65535, got " + std::to_string(port));
  return port;
}

}  // namespace

Receiver::Receiver(const ReceiverSettings& settings)
    : reader_(settings.form),
      ring_(settings.capacity),
      listener_(checked_port(settings.port), settings.any, kernel_buffer),
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
    const std::optional<std::size_t> count = listener_.receive(buffer, arrival_.sender);
    if (!count) return;
    arrival_.time = now();
    packets_.fetch_add(1, std::memory_order_relaxed);
    take_packet(buffer.first(*count));
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
