// Receiver: receives motion on a UDP port, on a thread of its own. It passes events on without
// locks in a queue of fixed size; events that do not fit are dropped and counted.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gait/joining_thread.h"
#include "gait/osc/event_ring.h"
#include "gait/osc/mocap_event.h"
#include "gait/osc/mocap_reader.h"
#include "gait/platform/udp_socket.h"

namespace gait::osc {

// From this machine, or from every one, over IPv4 and IPv6.
struct ReceiverSettings {
  int port = 39539;                  // 0: any free one
  bool any = false;                  // from other machines too, not only this one
  MocapForm form = MocapForm::none;  // none: every form that is recognised
  std::size_t capacity = 1 << 14;    // events: at 60 bones and 120 frames a second, two seconds
};

struct Received {  // since the beginning
  std::uint64_t packets = 0;
  std::uint64_t messages = 0;
  std::uint64_t unknown = 0;  // messages that move no body
  std::uint64_t faulty = 0;   // broken packets, wrong types or numbers
  std::uint64_t dropped = 0;  // events for which there was no room
};

class Receiver final : EventSink {
 public:
  // Opens the port and starts the thread. Throws Error when the port is taken or not allowed.
  explicit Receiver(const ReceiverSettings& settings);
  ~Receiver() override;
  Receiver(const Receiver&) = delete;
  Receiver& operator=(const Receiver&) = delete;

  int port() const noexcept { return listener_.port(); }
  // The next event, in the order of arrival; false when there is none. One thread at a time.
  bool pop(MocapEvent& event) noexcept { return ring_.pop(event); }
  Received received() const noexcept;
  // What the user should know about the stream, as one sentence; empty: nothing.
  std::string_view notice() const noexcept;
  // ": /face/eyes, /face/mouth": some addresses of messages that move no body; empty without any.
  std::string unknown_addresses() const;

  // The clock of arrivals, in seconds.
  static double now() noexcept;

 private:
  void run();
  void receive_all(std::span<std::byte> buffer);
  void take(const MocapEvent& event) override;
  void take_packet(std::span<const std::byte> packet);
  void count(Reading reading);
  void remember(std::string_view address);

  MocapReader reader_;
  EventRing<MocapEvent> ring_;
  UdpListener listener_;
  PacketWaiter waiter_{listener_};  // woken, it ends the thread
  Arrival arrival_;
  std::atomic<std::uint64_t> packets_{0}, messages_{0}, unknown_{0}, faulty_{0}, dropped_{0};
  std::atomic<Notice> notice_{Notice::none};
  mutable std::mutex unknown_mutex_;  // not for Pd's thread while it plays
  std::vector<std::string> unknown_addresses_;
  JoiningThread thread_;
};

}  // namespace gait::osc
