#include "gait/osc/mocap_reader.h"

#include <cmath>

namespace gait::osc {

Reading MocapReader::read(const OscMessage& message, const Arrival& arrival, EventSink& sink) {
  const auto wanted = [this](MocapForm form) { return form_ == MocapForm::none || form_ == form; };
  Reading reading = Reading::unknown;
  if (wanted(MocapForm::vmc)) reading = read_vmc(message, arrival, sink);
  if (reading == Reading::unknown && wanted(MocapForm::gait))
    reading = read_gait(message, arrival, sink);
  if (reading == Reading::unknown && wanted(MocapForm::natnet))
    reading = read_natnet(message, arrival, bone_numbers_, sink);
  if (reading == Reading::unknown && wanted(MocapForm::neuron))
    reading = read_neuron(message, arrival, sink);
  if (reading == Reading::unknown && wanted(MocapForm::kinect))
    reading = read_kinect(message, arrival, sink);
  return reading;
}

MocapEvent event_of(MocapKind kind, MocapForm form, const Arrival& arrival) {
  MocapEvent event;
  event.kind = kind;
  event.form = form;
  event.time = arrival.time;
  event.sender = arrival.sender;
  return event;
}

bool rotation_in(const OscMessage& message, int first, MocapEvent& event) {
  std::array<float, 4> q;
  if (!message.numbers(first, 4, q.data())) return false;
  const double norm = std::sqrt(double{q[0]} * q[0] + double{q[1]} * q[1] + double{q[2]} * q[2] +
                                double{q[3]} * q[3]);
  if (norm < 1e-3) return false;
  for (std::size_t i = 0; i < 4; ++i) event.rotation[i] = static_cast<float>(q[i] / norm);
  event.rotated = true;
  return true;
}

}  // namespace gait::osc
