#include "gait/osc/packet.h"

#include <lo/lo.h>
#include <lo/lo_lowlevel.h>

#include <cstdint>
#include <cstring>
#include <memory>

namespace gait::osc {

namespace {

constexpr std::size_t bundle_head = 16;  // "#bundle", a zero, the time

struct Opening {
  void (*take)(void* context, const OscMessage& message);
  void* context;
  PacketContent content;
};

struct FreeMessage {
  void operator()(lo_message message) const { lo_message_free(message); }
};

void open_message(std::span<const std::byte> bytes, Opening& opening) {
  int result = 0;
  // liblo checks every length, and copies: it does not write to what it is given.
  const std::unique_ptr<std::remove_pointer_t<lo_message>, FreeMessage> message(
      lo_message_deserialise(const_cast<std::byte*>(bytes.data()), bytes.size(), &result));
  if (!message) {
    ++opening.content.faulty;
    return;
  }
  ++opening.content.messages;
  opening.take(
      opening.context,
      OscMessage(reinterpret_cast<const char*>(bytes.data()), lo_message_get_types(message.get()),
                 reinterpret_cast<const void* const*>(lo_message_get_argv(message.get()))));
}

void open(std::span<const std::byte> bytes, int depth, Opening& opening) {
  if (bytes.size() < 8 || bytes.size() % 4 != 0) {
    ++opening.content.faulty;
    return;
  }
  if (std::memcmp(bytes.data(), "#bundle", 8) != 0) {
    open_message(bytes, opening);
    return;
  }
  if (bytes.size() < bundle_head || depth >= deepest_bundle) {
    ++opening.content.faulty;
    return;
  }
  bytes = bytes.subspan(bundle_head);
  while (!bytes.empty()) {
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size = size << 8 | std::to_integer<std::uint32_t>(bytes[i]);
    bytes = bytes.subspan(4);
    if (size > bytes.size() || size % 4 != 0) {
      ++opening.content.faulty;
      return;
    }
    open(bytes.first(size), depth + 1, opening);
    bytes = bytes.subspan(size);
  }
}

}  // namespace

bool is_osc(std::span<const std::byte> bytes) noexcept {
  return (!bytes.empty() && bytes[0] == std::byte{'/'}) ||
         (bytes.size() >= 8 && std::memcmp(bytes.data(), "#bundle", 8) == 0);
}

PacketContent open_packet(std::span<const std::byte> bytes,
                          void (*take)(void* context, const OscMessage& message), void* context) {
  Opening opening{take, context, {}};
  open(bytes, 0, opening);
  return opening.content;
}

}  // namespace gait::osc
