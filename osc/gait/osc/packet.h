// Packet: reads the messages in one datagram. Time tags of bundles are ignored, because live motion
// counts on arrival.
#pragma once

#include <cstddef>
#include <span>

#include "gait/osc/osc_message.h"

namespace gait::osc {

struct PacketContent {
  int messages = 0;  // given to `take`
  int faulty = 0;    // parts that are no message, wrong sizes, bundles nested too deep
};

// Deepest nesting of bundles that is read; senders of motion do not nest at all.
inline constexpr int deepest_bundle = 8;

// Whether a datagram begins as OSC does.
bool is_osc(std::span<const std::byte> bytes) noexcept;

// Calls `take(context, message)` for each message in order. Bytes need not be OSC.
PacketContent open_packet(std::span<const std::byte> bytes,
                          void (*take)(void* context, const OscMessage& message), void* context);

}  // namespace gait::osc
