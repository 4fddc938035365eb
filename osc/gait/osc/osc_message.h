// OSC message: address and arguments of one message; arguments are checked when they are read.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace gait::osc {

class OscMessage {
 public:
  // `arguments`: one pointer per type, in this machine's byte order; strings end in a zero. All
  // must outlive this.
  OscMessage(std::string_view path, std::string_view types, const void* const* arguments)
      : path_(path), types_(types), arguments_(arguments) {}

  std::string_view path() const noexcept { return path_; }
  int size() const noexcept { return static_cast<int>(types_.size()); }

  // Of any numeric type (i h f d T F), finite.
  std::optional<double> number(int i) const noexcept;
  std::optional<std::string_view> text(int i) const noexcept;  // s or S
  // An identifier of a stream: the number itself, or the hash of a name.
  std::optional<std::uint32_t> key(int i) const noexcept;

  // `count` finite numbers from argument `first` on. False, with nothing written, where there are
  // fewer or they are no numbers.
  bool numbers(int first, int count, float* values) const noexcept;

 private:
  std::string_view path_, types_;
  const void* const* arguments_;
};

std::uint32_t key_of(std::string_view text) noexcept;

}  // namespace gait::osc
