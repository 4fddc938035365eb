// Random numbers that are the same everywhere: SplitMix64 (Steele, Lea, Flood 2014), uniform over
// (0, 1). The standard library's distributions differ from one library to the next.
#pragma once

#include <cstdint>

namespace gait {

class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) noexcept : state_(seed) {}

  // Neither 0 nor 1.
  double uniform() noexcept {
    return (static_cast<double>(bits() >> 11) + 0.5) * (1.0 / 9007199254740992.0);
  }

 private:
  std::uint64_t bits() noexcept {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9ULL;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebULL;
    return mixed ^ (mixed >> 31);
  }

  std::uint64_t state_;
};

}  // namespace gait
