// UDP over IPv4, and waiting for packets on a thread that another one can wake.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace gait {

struct UdpAddress {
  std::uint32_t host = 0;  // the most significant byte first in a.b.c.d: a
  std::uint16_t port = 0;
};

// Looks a name or a.b.c.d up, which may take seconds. Throws Error with the system's reason.
std::uint32_t find_host(const std::string& name);

// Never blocks. Programs that this one starts do not inherit it.
class UdpSocket {
 public:
  UdpSocket();  // to send, to broadcast addresses too; throws Error
  // To receive on `port` (0: any free one) from this machine, or from `any`. `buffer`: bytes that
  // the system should keep until they are received. Throws Error when the port is taken or not
  // allowed.
  UdpSocket(int port, bool any, int buffer);
  ~UdpSocket();
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  int port() const;  // that it receives on
  // Returns false when the system refused the datagram.
  bool send(std::span<const std::byte> bytes, UdpAddress to) const noexcept;
  // The size of the next datagram, whose bytes beyond `buffer` are lost; nothing when none waits.
  std::optional<std::size_t> receive(std::span<std::byte> buffer, UdpAddress& from) const noexcept;

 private:
  friend class PacketWaiter;
  std::intptr_t socket_;  // the system's handle
};

class PacketWaiter {
 public:
  explicit PacketWaiter(const UdpSocket& socket);  // which must outlive it; throws Error
  ~PacketWaiter();
  PacketWaiter(const PacketWaiter&) = delete;
  PacketWaiter& operator=(const PacketWaiter&) = delete;

  // Waits. True: there are packets to receive. False: it was woken, now or before, or cannot wait.
  bool wait() noexcept;
  // From another thread.
  void wake() noexcept;

 private:
  const UdpSocket& socket_;
  std::intptr_t woken_ = -1, waking_ = -1;  // two ends: a byte in the one is seen at the other
};

}  // namespace gait
