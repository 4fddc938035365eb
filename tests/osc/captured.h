// Packets as a sender would make them, read back without a socket.
#pragma once

#include <string>
#include <vector>

#include "gait/osc/frame_gatherer.h"
#include "gait/osc/mocap_reader.h"
#include "gait/osc/packet.h"
#include "gait/osc/packet_template.h"

namespace gait::testing {

// What a reader makes of packets.
class Listened final : public osc::EventSink, public osc::FrameSink {
 public:
  explicit Listened(int slots = 1, osc::MocapForm form = osc::MocapForm::none)
      : reader(form), gatherer(slots) {}

  // `time`: of arrival, seconds. Another `sender`, another machine.
  void hear(std::span<const std::byte> packet, double time, std::uint8_t sender = 1) {
    hear(packet, time, machine(sender));
  }
  static UdpAddress machine(std::uint8_t number, std::uint16_t port = 1) {
    return {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 10, 0, 0, number}, port};
  }
  void hear(std::span<const std::byte> packet, double time, const UdpAddress& sender) {
    arrival = {time, sender};
    if (!osc::is_osc(packet)) {
      count(reader.read(packet, arrival, *this));
      return;
    }
    faulty += osc::open_packet(
                  packet,
                  [](void* self, const osc::OscMessage& message) {
                    static_cast<Listened*>(self)->message(message);
                  },
                  this)
                  .faulty;
  }
  template <class Packet, class Sender = std::uint8_t>
  void hear_all(const std::span<const Packet>& packets, double time, Sender sender = Sender{1}) {
    for (const auto& packet : packets) hear(packet.bytes(), time, sender);
  }
  // One message, all numbers as f or i.
  void say(const std::string& path, const std::string& types,
           const std::vector<std::string>& strings, const std::vector<float>& numbers,
           double time = 0) {
    osc::PacketTemplate packet;
    packet.add(path, types, strings);
    packet.set(numbers);
    hear(packet.bytes(), time);
  }

  void take(const osc::MocapEvent& event) override {
    events.push_back(event);
    gatherer.take(event, *this);
  }
  void frame(int performer, const osc::CapturedFrame& captured) noexcept override {
    performers.push_back(performer);
    frames.push_back(captured);
  }

  osc::MocapReader reader;
  osc::FrameGatherer gatherer;
  osc::Arrival arrival;
  std::vector<osc::MocapEvent> events;
  std::vector<osc::CapturedFrame> frames;
  std::vector<int> performers;
  int faulty = 0, unknown = 0;

 private:
  void message(const osc::OscMessage& message) { count(reader.read(message, arrival, *this)); }
  void count(osc::Reading reading) {
    if (reading == osc::Reading::faulty) ++faulty;
    if (reading == osc::Reading::unknown) ++unknown;
  }
};

}  // namespace gait::testing
