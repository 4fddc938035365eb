// Form reader: turns messages or datagrams of one form into events. Each recognises its own by the
// address or by the first bytes; a bad message is faulty as a whole. One reader reads all senders
// on a port, on the receiving thread.
#pragma once

#include <cstddef>
#include <span>

#include "gait/osc/mocap_event.h"
#include "gait/osc/osc_message.h"

namespace gait::osc {

enum class Reading { taken, unknown, faulty };

// Data that all events of a message share.
struct Arrival {
  double time = 0;  // seconds
  UdpAddress sender;
};

class FormReader {
 public:
  virtual ~FormReader() = default;
  virtual Reading read(const OscMessage&, const Arrival&, EventSink&) { return Reading::unknown; }
  // A whole datagram that is not OSC.
  virtual Reading read(std::span<const std::byte>, const Arrival&, EventSink&) {
    return Reading::unknown;
  }
};

// A form of which each message is read by itself.
using ReadMessage = Reading (*)(const OscMessage&, const Arrival&, EventSink&);

// An event with the data that all events have.
MocapEvent event_of(MocapKind kind, MocapForm form, const Arrival& arrival);
// Takes four numbers x y z w as the event's rotation; returns false when they are not finite or
// near zero.
bool set_rotation(std::span<const float, 4> q, MocapEvent& event);
// The same from a message's argument `first` on.
bool rotation_in(const OscMessage& message, int first, MocapEvent& event);

}  // namespace gait::osc
