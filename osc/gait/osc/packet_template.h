// Packet template: a bundle whose words never change and whose numbers do. liblo lays it out once;
// after that a frame is a few bytes written into place and one datagram.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace gait::osc {

class PacketTemplate {
 public:
  // Adds a message: `types` as OSC names them, of s, i and f; the strings in order. Its numbers (i
  // and f) are set with set(). Throws Error when it does not fit a packet.
  void add(const std::string& path, const std::string& types,
           const std::vector<std::string>& strings = {});
  // How many bytes it has so far, and would have with such a message.
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

// Several packets in a row, none beyond what passes a network whole; a message that does not fit
// begins the next.
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
