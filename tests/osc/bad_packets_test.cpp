// The packet path against everything: mutated packets straight into the parser and through a real
// socket, floods, lies about sizes. Nothing may crash, and memory is bounded.
#include "osc/bad_packets.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <thread>

#include "gait/corpus/demo_model.h"
#include "gait/error.h"
#include "gait/osc/destination.h"
#include "gait/osc/live_body.h"
#include "gait/osc/receiver.h"
#include "osc/captured.h"

namespace gait::testing {
namespace {

constexpr auto fuzzed_for = std::chrono::seconds(2);

TEST(BadPackets, mutated_ones_leave_a_body_of_finite_numbers) {
  const auto model = std::make_shared<const Model>(make_demo_model());
  osc::LiveBody live(model);
  live.calibrate(CalibrationPose::t);
  live.set_smoothing(2);
  Listened listened(4);
  const std::vector<Packet> honest = honest_packets();
  std::mt19937 random(1);
  const auto end = std::chrono::steady_clock::now() + fuzzed_for;
  int packets = 0, frames = 0;
  while (std::chrono::steady_clock::now() < end) {
    const Packet packet =
        random() % 8 == 0 ? honest[random() % honest.size()] : mutated(honest, random);
    listened.hear(packet, packets * 0.001, static_cast<std::uint8_t>(random() % 6));
    ++packets;
    for (const auto& frame : listened.frames) {
      if (!live.take(frame)) continue;
      ++frames;
      for (const float value : live.frame().pose) ASSERT_TRUE(std::isfinite(value));
      for (const float value : live.frame().inputs) ASSERT_TRUE(std::isfinite(value));
      ASSERT_TRUE(live.frame().hips.allFinite());
    }
    listened.frames.clear();
    listened.performers.clear();
    listened.events.clear();
  }
  EXPECT_GT(packets, 1000);
  EXPECT_GT(frames, 10);
  EXPECT_GT(listened.faulty, 100);
}

// A socket that sends anything to a receiver on this machine.
class Sender {
 public:
  explicit Sender(int port) : to_("127.0.0.1", port) {}
  bool send(std::span<const std::byte> packet) const { return to_.send(packet); }

 private:
  osc::Destination to_;
};

TEST(BadPackets, through_a_real_socket_leave_it_listening) {
  osc::Receiver receiver({.port = 0});
  const Sender sender(receiver.port());
  const std::vector<Packet> honest = honest_packets();
  std::mt19937 random(2);
  osc::MocapEvent event;
  const auto end = std::chrono::steady_clock::now() + fuzzed_for;
  while (std::chrono::steady_clock::now() < end) {
    sender.send(mutated(honest, random));
    while (receiver.pop(event)) {
      for (const float x : event.place) ASSERT_TRUE(std::isfinite(x));
      for (const float x : event.rotation) ASSERT_TRUE(std::isfinite(x));
    }
  }
  EXPECT_GT(receiver.received().faulty, 10u);
  while (receiver.pop(event)) continue;
  bool heard = false;
  for (int i = 0; i < 200 && !heard; ++i) {
    sender.send(honest[0]);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    while (receiver.pop(event)) heard = heard || event.kind == osc::MocapKind::root;
  }
  EXPECT_TRUE(heard);
}

// Bounded in time and count, and on this machine alone.
TEST(BadPackets, a_flood_is_dropped_and_counted_and_over_when_it_is_over) {
  osc::Receiver receiver({.port = 0, .capacity = 256});
  const Sender sender(receiver.port());
  const Packet packet = honest_packets()[0];
  int sent = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
  while (std::chrono::steady_clock::now() < end && sent < 200000) sent += sender.send(packet);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  osc::MocapEvent event;
  int kept = 0;
  while (receiver.pop(event)) ++kept;
  EXPECT_LE(kept, 256);  // nobody took them in time: the ring's room, no more
  const osc::Received received = receiver.received();
  EXPECT_GT(received.dropped, 0u);
  EXPECT_EQ(received.messages * 1, received.dropped + static_cast<std::uint64_t>(kept));
  EXPECT_LE(received.packets, static_cast<std::uint64_t>(sent));
}

TEST(BadPackets, a_port_that_is_taken_or_a_host_that_is_not_there_is_said) {
  const osc::Receiver first({.port = 0});
  try {
    const osc::Receiver second({.port = first.port()});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("is taken by another program"), std::string::npos);
  }
  EXPECT_THROW(osc::Destination("no.such.host.invalid", 39539), Error);
  EXPECT_THROW(osc::Destination("localhost", 70000), Error);
}

// From another address of this machine than the loopback one nobody gets in, unless asked for.
TEST(BadPackets, a_receiver_is_bound_to_this_machine_alone) {
  const osc::Receiver receiver({.port = 0});
  const int probe = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(receiver.port()));
  address.sin_addr.s_addr = inet_addr("127.0.0.2");  // free: the receiver has 127.0.0.1 only
  EXPECT_EQ(bind(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  close(probe);
}

TEST(BadPackets, a_sender_that_changes_its_rig_goes_on) {
  Listened listened;
  for (int i = 0; i < 5000; ++i)
    listened.say("/gait/quat", "sffff", {"joint" + std::to_string(i)}, {0, 0, 0, 1}, i * 0.001);
  EXPECT_LE(listened.gatherer.last(0).joints, osc::most_joints);
  EXPECT_GT(listened.gatherer.refused(), 0u);
  listened.gatherer.end_old(5.02, listened);
  const std::size_t frames = listened.frames.size();
  listened.say("/gait/quat", "sffff", {"joint7"}, {0, 1, 0, 0}, 5.03);
  listened.gatherer.end_old(5.1, listened);
  EXPECT_EQ(listened.frames.size(), frames + 1);
  // After a second's silence it may be another rig.
  listened.say("/gait/quat", "sffff", {"joint4711"}, {0, 0, 0, 1}, 7);
  EXPECT_EQ(listened.gatherer.last(0).joints, 1);
}

}  // namespace
}  // namespace gait::testing
