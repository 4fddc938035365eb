// Packet: what one datagram holds, message by message. Bundles are opened at once, whatever time
// they ask for: motion is of now.
#pragma once

#include <cstddef>
#include <span>

#include "gait/osc/osc_message.h"

namespace gait::osc {

struct PacketContent {
  int messages = 0;  // given to `take`
  int faulty = 0;    // pieces that are no message, sizes that lie, bundles nested too deep
};

// Deepest nesting of bundles that is followed; nobody who sends motion nests at all.
inline constexpr int deepest_bundle = 8;

// Calls `take(context, message)` for each message in order. Bytes need not be OSC.
PacketContent open_packet(std::span<const std::byte> bytes,
                          void (*take)(void* context, const OscMessage& message), void* context);

}  // namespace gait::osc
