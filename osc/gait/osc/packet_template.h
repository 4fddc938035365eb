// Packet template: a bundle with constant strings and variable numbers. liblo lays it out once; for
// each frame only the numbers are written.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace gait::osc {

class PacketTemplate {
 public:
  static constexpr std::size_t head = 20;  // bytes of the bundle before its first message

  // Adds a message: `types` as OSC names them, of s, i and f; the strings in order. Its numbers (i
  // and f) are set with set(). Throws Error when it does not fit a packet.
  void add(const std::string& path, const std::string& types,
           const std::vector<std::string>& strings = {});
  // Size in bytes so far, and the bytes that such a message takes.
  std::size_t size() const noexcept { return bytes_.size(); }
  static std::size_t size_of(const std::string& path, const std::string& types,
                             const std::vector<std::string>& strings);

  int numbers() const noexcept { return static_cast<int>(places_.size()); }
  // All numbers, in the order of the messages; those of type i are rounded.
  void set(std::span<const float> numbers) noexcept;
  std::span<const std::byte> bytes() const noexcept { return bytes_; }

 private:
  struct Place {
    std::size_t at;
    bool whole;
  };
  std::vector<std::byte> bytes_;
  std::vector<Place> places_;
};

// Several packets in a row, each small enough for one datagram; a message that does not fit begins
// the next packet.
class PacketSequence {
 public:
  static constexpr std::size_t most_bytes = 1400;  // within 1500, as the VMC protocol asks

  void add(const std::string& path, const std::string& types,
           const std::vector<std::string>& strings = {});
  // The next message begins another packet.
  void cut() { cut_ = true; }
  int numbers() const noexcept;
  void set(std::span<const float> numbers) noexcept;
  std::span<const PacketTemplate> packets() const noexcept { return packets_; }

 private:
  std::vector<PacketTemplate> packets_;
  bool cut_ = true;
};

}  // namespace gait::osc
