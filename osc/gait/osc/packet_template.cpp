#include "gait/osc/packet_template.h"

#include <lo/lo.h>
#include <lo/lo_lowlevel.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>

#include "gait/error.h"

namespace gait::osc {

namespace {

constexpr std::size_t largest_packet = 60000;
constexpr std::size_t bundle_head = 16;

std::size_t padded(std::size_t text) { return (text + 4) / 4 * 4; }

void put(std::vector<std::byte>& bytes, std::size_t at, std::uint32_t word) noexcept {
  for (std::size_t i = 0; i < 4; ++i)
    bytes[at + i] = static_cast<std::byte>(word >> (24 - 8 * i) & 0xFF);
}

struct FreeMessage {
  void operator()(lo_message message) const { lo_message_free(message); }
};

}  // namespace

std::size_t PacketTemplate::size_of(const std::string& path, const std::string& types,
                                    const std::vector<std::string>& strings) {
  std::size_t size = 4 + padded(path.size()) + padded(1 + types.size());
  for (const std::string& text : strings) size += padded(text.size());
  return size + 4 * (types.size() - strings.size());
}

void PacketTemplate::add(const std::string& path, const std::string& types,
                         const std::vector<std::string>& strings) {
  const std::unique_ptr<std::remove_pointer_t<lo_message>, FreeMessage> message(lo_message_new());
  std::size_t next = 0;
  for (const char type : types)
    if (type == 's')
      lo_message_add_string(message.get(), strings.at(next++).c_str());
    else if (type == 'i')
      lo_message_add_int32(message.get(), 0);
    else
      lo_message_add_float(message.get(), 0);
  const std::size_t length = lo_message_length(message.get(), path.c_str());
  if (bytes_.empty()) {
    bytes_.resize(bundle_head);
    for (std::size_t i = 0; i < 7; ++i) bytes_[i] = static_cast<std::byte>("#bundle"[i]);
    put(bytes_, 12, 1);  // at once
  }
  const std::size_t begin = bytes_.size();
  if (begin + 4 + length > largest_packet)
    throw Error("expected a frame that fits a datagram, got one of more than " +
                std::to_string(largest_packet) + " bytes");
  bytes_.resize(begin + 4 + length);
  put(bytes_, begin, static_cast<std::uint32_t>(length));
  std::size_t size = length;
  lo_message_serialise(message.get(), path.c_str(), bytes_.data() + begin + 4, &size);
  std::size_t at = begin + 4 + padded(path.size()) + padded(1 + types.size());
  next = 0;
  for (const char type : types)
    if (type == 's') {
      at += padded(strings[next++].size());
    } else {
      places_.push_back({at, type == 'i'});
      at += 4;
    }
}

void PacketTemplate::set(std::span<const float> numbers) noexcept {
  for (std::size_t i = 0; i < places_.size() && i < numbers.size(); ++i)
    put(bytes_, places_[i].at,
        places_[i].whole ? static_cast<std::uint32_t>(std::lround(numbers[i]))
                         : std::bit_cast<std::uint32_t>(numbers[i]));
}

void PacketSequence::add(const std::string& path, const std::string& types,
                         const std::vector<std::string>& strings) {
  if (cut_ || packets_.back().size() + PacketTemplate::size_of(path, types, strings) > most_bytes)
    packets_.emplace_back();
  cut_ = false;
  packets_.back().add(path, types, strings);
}

int PacketSequence::numbers() const noexcept {
  int count = 0;
  for (const PacketTemplate& packet : packets_) count += packet.numbers();
  return count;
}

void PacketSequence::set(std::span<const float> numbers) noexcept {
  for (PacketTemplate& packet : packets_) {
    const auto count = static_cast<std::size_t>(packet.numbers());
    packet.set(numbers.first(std::min(count, numbers.size())));
    numbers = numbers.subspan(std::min(count, numbers.size()));
  }
}

}  // namespace gait::osc
