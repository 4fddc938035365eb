#include "gait/osc/osc_message.h"

#include <cmath>
#include <cstring>

namespace gait::osc {

namespace {

constexpr float largest = 1e6F;  // metres or units; larger numbers are errors of the sender

template <typename T>
T read(const void* from) noexcept {  // arguments lie on four bytes, not on eight
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

}  // namespace

std::optional<double> OscMessage::number(int i) const noexcept {
  if (i < 0 || i >= size()) return std::nullopt;
  double value = 0;
  switch (types_[static_cast<std::size_t>(i)]) {
    case 'i':
      value = read<std::int32_t>(arguments_[i]);
      break;
    case 'h':
      value = static_cast<double>(read<std::int64_t>(arguments_[i]));
      break;
    case 'f':
      value = read<float>(arguments_[i]);
      break;
    case 'd':
      value = read<double>(arguments_[i]);
      break;
    case 'T':
      value = 1;
      break;
    case 'F':
      break;
    default:
      return std::nullopt;
  }
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::string_view> OscMessage::text(int i) const noexcept {
  if (i < 0 || i >= size()) return std::nullopt;
  const char type = types_[static_cast<std::size_t>(i)];
  if (type != 's' && type != 'S') return std::nullopt;
  return std::string_view(static_cast<const char*>(arguments_[i]));
}

std::optional<std::uint32_t> OscMessage::key(int i) const noexcept {
  if (const auto name = text(i)) return key_of(*name);
  if (const auto value = number(i))
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::fmod(*value, 4294967296.0)));
  return std::nullopt;
}

bool OscMessage::numbers(int first, int count, float* values) const noexcept {
  if (first < 0 || first + count > size()) return false;
  for (int i = 0; i < count; ++i) {
    const auto value = number(first + i);
    if (!value || std::abs(*value) > largest) return false;
  }
  for (int i = 0; i < count; ++i) values[i] = static_cast<float>(*number(first + i));
  return true;
}

std::uint32_t key_of(std::string_view text) noexcept {  // FNV-1a
  std::uint32_t hash = 2166136261U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash;
}

}  // namespace gait::osc
