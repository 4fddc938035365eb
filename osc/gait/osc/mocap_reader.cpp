#include "gait/osc/mocap_reader.h"

#include <cmath>

#include "gait/osc/forms.h"

namespace gait::osc {

MocapReader::MocapReader(MocapForm form) {
  for (const FormFacts& facts : all_forms())
    if (form == MocapForm::none || form == facts.form) readers_.push_back(facts.reader());
}

Reading MocapReader::read(const OscMessage& message, const Arrival& arrival, EventSink& sink) {
  for (const auto& reader : readers_)
    if (const Reading reading = reader->read(message, arrival, sink); reading != Reading::unknown)
      return reading;
  return Reading::unknown;
}

Reading MocapReader::read(std::span<const std::byte> datagram, const Arrival& arrival,
                          EventSink& sink) {
  for (const auto& reader : readers_)
    if (const Reading reading = reader->read(datagram, arrival, sink); reading != Reading::unknown)
      return reading;
  return Reading::unknown;
}

MocapEvent event_of(MocapKind kind, MocapForm form, const Arrival& arrival) {
  MocapEvent event;
  event.kind = kind;
  event.form = form;
  event.time = arrival.time;
  event.sender = arrival.sender;
  return event;
}

bool set_rotation(std::span<const float, 4> q, MocapEvent& event) {
  const double norm = std::sqrt(double{q[0]} * q[0] + double{q[1]} * q[1] + double{q[2]} * q[2] +
                                double{q[3]} * q[3]);
  if (!(norm >= 1e-3) || !std::isfinite(norm)) return false;
  for (std::size_t i = 0; i < 4; ++i) event.rotation[i] = static_cast<float>(q[i] / norm);
  event.rotated = true;
  return true;
}

bool rotation_in(const OscMessage& message, int first, MocapEvent& event) {
  std::array<float, 4> q;
  return message.numbers(first, 4, q.data()) && set_rotation(q, event);
}

}  // namespace gait::osc
