#include "gait/platform/udp_socket.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <thread>

#include "gait/error.h"

namespace gait {
namespace {

constexpr std::array<std::byte, 8> packet{std::byte{1}, std::byte{2}};

UdpAddress address_of(const std::string& host, int port) {
  return addresses_of(host, port, "test").at(0);
}

bool has_ipv6() {
  UdpListener listener(0, false, 1 << 16);
  std::array<std::byte, 8> got;
  UdpAddress from;
  const UdpSender sender(address_of("::1", listener.port()));
  sender.send(packet);
  return listener.receive(got, from).has_value();
}

TEST(UdpSocket, packets_arrive_with_their_sender_and_waiting_ends) {
  UdpListener listener(0, false, 1 << 16);
  PacketWaiter waiter(listener);
  std::array<std::byte, 8> got{};
  UdpAddress from;
  EXPECT_FALSE(listener.receive(got, from));

  const UdpAddress to = address_of("127.0.0.1", listener.port());
  EXPECT_TRUE(to.ipv4());
  EXPECT_EQ(to.name(), "127.0.0.1:" + std::to_string(listener.port()));
  const UdpSender sender(to);
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(sender.send(packet), Sent::yes);
  });
  EXPECT_TRUE(waiter.wait());
  other.join();
  EXPECT_EQ(listener.receive(got, from), packet.size());
  EXPECT_EQ(got, packet);
  EXPECT_EQ(from.host, to.host);
  EXPECT_NE(from.port, 0);

  std::thread waker([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    waiter.wake();
  });
  EXPECT_FALSE(waiter.wait());
  waker.join();
  EXPECT_FALSE(waiter.wait()) << "woken before: it stays awake";
}

TEST(UdpSocket, one_port_hears_both_families_and_neither_keeps_the_other_waiting) {
  if (!has_ipv6()) GTEST_SKIP() << "no IPv6 on this machine";
  UdpListener listener(0, false, 1 << 16);
  PacketWaiter waiter(listener);
  const UdpSender four(address_of("127.0.0.1", listener.port())),
      six(address_of("::1", listener.port()));
  std::array<std::byte, 8> got{};
  UdpAddress from;
  EXPECT_EQ(six.send(packet), Sent::yes);
  EXPECT_TRUE(waiter.wait());
  EXPECT_EQ(listener.receive(got, from), packet.size());
  EXPECT_EQ(from.name(), "[::1]:" + std::to_string(from.port));
  for (int i = 0; i < 10; ++i) EXPECT_EQ(four.send(packet), Sent::yes);
  EXPECT_EQ(six.send(packet), Sent::yes);
  int ipv4 = 0, ipv6_by_the_second = 0;
  for (int i = 0; listener.receive(got, from); ++i) {
    ipv4 += from.ipv4() ? 1 : 0;
    ipv6_by_the_second += !from.ipv4() && i < 2 ? 1 : 0;
  }
  EXPECT_EQ(ipv4, 10);
  EXPECT_EQ(ipv6_by_the_second, 1);
}

TEST(UdpSocket, a_sender_learns_that_its_packets_are_refused) {
  for (const char* host : {"127.0.0.1", "::1"}) {
    if (*host == ':' && !has_ipv6()) continue;
    int port = 0;
    {
      const UdpListener closed(0, false, 1 << 16);
      port = closed.port();
    }
    const UdpSender sender(address_of(host, port));
    EXPECT_EQ(sender.send(packet), Sent::yes);
    EXPECT_EQ(sender.send(packet), Sent::refused) << host;
    EXPECT_EQ(sender.send(std::vector<std::byte>(100000)), Sent::no) << host;
  }
}

TEST(UdpSocket, a_taken_port_is_refused_by_its_number) {
  const UdpListener first(0, false, 1 << 16);
  try {
    const UdpListener second(first.port(), false, 1 << 16);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.what(),
              "port " + std::to_string(first.port()) + " is taken by another program");
  }
}

TEST(UdpSocket, a_host_that_is_not_there_is_refused) {
  try {
    addresses_of("no such host.", 1, "no such host.:1");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("no such host.:1: no host of that name"));
  }
}

}  // namespace
}  // namespace gait
