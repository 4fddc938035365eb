#include "gait/platform/udp_socket.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <thread>

#include "gait/error.h"

namespace gait {
namespace {

constexpr std::uint32_t here = 0x7F000001;

TEST(UdpSocket, packets_arrive_with_their_sender_and_waiting_ends) {
  const UdpSocket receiver(0, false, 1 << 16);
  PacketWaiter waiter(receiver);
  std::array<std::byte, 8> packet{std::byte{1}, std::byte{2}}, got{};
  UdpAddress from;
  EXPECT_FALSE(receiver.receive(got, from));

  const UdpSocket sender;
  const UdpAddress to{find_host("localhost"), static_cast<std::uint16_t>(receiver.port())};
  EXPECT_EQ(to.host, here);
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_TRUE(sender.send(packet, to));
  });
  EXPECT_TRUE(waiter.wait());
  other.join();
  EXPECT_EQ(receiver.receive(got, from), packet.size());
  EXPECT_EQ(got, packet);
  EXPECT_EQ(from.host, here);
  EXPECT_NE(from.port, 0);

  std::thread waker([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    waiter.wake();
  });
  EXPECT_FALSE(waiter.wait());
  waker.join();
  EXPECT_FALSE(waiter.wait()) << "woken before: it stays awake";
}

TEST(UdpSocket, a_taken_port_is_refused_by_its_number) {
  const UdpSocket first(0, false, 1 << 16);
  try {
    const UdpSocket second(first.port(), false, 1 << 16);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(),
              "port " + std::to_string(first.port()) + " is taken by another program");
  }
}

TEST(UdpSocket, a_host_that_is_not_there_is_refused) {
  EXPECT_THROW(find_host("no such host."), Error);
}

}  // namespace
}  // namespace gait
