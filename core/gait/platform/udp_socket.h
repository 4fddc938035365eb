// UDP over IPv4 and IPv6, and waiting for packets on a thread that another one can wake. No socket
// ever blocks, and programs that this one starts inherit none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gait/platform/udp_address.h"

namespace gait {

// All addresses of a host, in the order in which the system prefers them. `host`: a name, a.b.c.d,
// or an IPv6 address. May take seconds. Throws Error, whose text begins with `name`, with the
// system's reason.
std::vector<UdpAddress> addresses_of(const std::string& host, int port, const std::string& name);

enum class Sent {
  yes,
  no,           // too large, or too much waits to be sent
  refused,      // no program took an earlier datagram; this one was not sent
  unreachable,  // there is no way to that address now
};

// Sends to one address, which may be a broadcast address.
class UdpSender {
 public:
  explicit UdpSender(const UdpAddress& to);  // throws Error; an address out of reach is no reason
  ~UdpSender();
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;

  // Sends one datagram.
  Sent send(std::span<const std::byte> bytes) const noexcept;

 private:
  UdpAddress to_;
  std::intptr_t socket_;  // the system's handle
};

// Receives on one port, over each of the two families that this machine has.
class UdpListener {
 public:
  // `port` 0: any free one. Receives from this machine, or from `any`. `buffer`: bytes that the
  // system should keep until they are received. Throws Error when the port is taken or not allowed.
  UdpListener(int port, bool any, int buffer);
  ~UdpListener();
  UdpListener(const UdpListener&) = delete;
  UdpListener& operator=(const UdpListener&) = delete;

  int port() const noexcept { return port_; }
  // The size of the next datagram, whose bytes beyond `buffer` are lost; nothing when none waits.
  std::optional<std::size_t> receive(std::span<std::byte> buffer, UdpAddress& from) noexcept;

 private:
  friend class PacketWaiter;
  void close_all() noexcept;

  std::array<std::intptr_t, 2> sockets_{-1, -1};  // of IPv4, of IPv6; -1: not on this machine
  int port_ = 0;
  std::size_t next_ = 0;  // the socket whose turn it is: neither keeps the other one waiting
};

class PacketWaiter {
 public:
  explicit PacketWaiter(const UdpListener& listener);  // which must outlive it; throws Error
  ~PacketWaiter();
  PacketWaiter(const PacketWaiter&) = delete;
  PacketWaiter& operator=(const PacketWaiter&) = delete;

  // Waits. True: there are packets to receive. False: it was woken, now or before, or cannot wait.
  bool wait() noexcept;
  // From another thread.
  void wake() noexcept;

 private:
  const UdpListener& listener_;
  std::intptr_t woken_ = -1, waking_ = -1;  // two ends: a byte in the one is seen at the other
};

}  // namespace gait
