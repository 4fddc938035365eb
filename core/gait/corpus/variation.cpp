#include "gait/corpus/variation.h"

#include <algorithm>
#include <cmath>

namespace gait {
namespace {

// FNV-1a, then the finaliser of splitmix64: names that differ in one letter get unlike seeds.
std::uint64_t mixed(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325ULL ^ seed;
  for (const char letter : name)
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3ULL;
  hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9ULL;
  hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebULL;
  return hash ^ (hash >> 31);
}

}  // namespace

Deviates::Deviates(std::uint64_t seed, std::string_view name) : engine_(mixed(seed, name)) {}

double Deviates::normal() {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(engine_() >> 11) * 0x1p-53;
  return sum;
}

std::vector<double> step_deviates(Deviates& deviates, int steps, double persistence) {
  std::vector<double> values(static_cast<std::size_t>(steps));
  const double fresh = std::sqrt(1 - persistence * persistence);
  double value = deviates.normal();
  for (double& v : values) {
    v = std::clamp(value, -2.5, 2.5);
    value = persistence * value + fresh * deviates.normal();
  }
  return values;
}

ApproximatingCurve step_variation(Deviates deviates, int first_step, int steps, double persistence,
                                  double take_share) {
  // A B-spline through white control values keeps about two thirds of their deviation.
  constexpr double loss = 1.5;
  const double constant = take_share * std::clamp(deviates.normal(), -2.0, 2.0);
  std::vector<double> control = step_deviates(deviates, steps, persistence);
  const double moving =
      std::sqrt(1 - take_share * take_share) * (1 + (loss - 1) * (1 - persistence));
  for (double& value : control) value = constant + moving * value;
  return ApproximatingCurve(first_step, 1, std::move(control));
}

}  // namespace gait
