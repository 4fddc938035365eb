// How a walk varies from step to step: random curves that are the same on every machine.
//
// Deviates come from std::mt19937_64, whose sequence the standard fixes, and a sum of uniforms,
// which needs no library function that differs between platforms.
#pragma once

#include <cstdint>
#include <random>
#include <string_view>
#include <vector>

#include "gait/corpus/smooth_curve.h"

namespace gait {

// A stream of deviates of its own for each (seed, name): adding one stream changes no other.
class Deviates {
 public:
  Deviates(std::uint64_t seed, std::string_view name);

  // Nearly standard normal (Irwin-Hall of twelve), within -6..6.
  double normal();

 private:
  std::mt19937_64 engine_;
};

// One value a step, each leaning on the one before by `persistence` (0..1): stationary, zero mean,
// unit deviation, and within -2.5..2.5 so that no step is absurd.
std::vector<double> step_deviates(Deviates& deviates, int steps, double persistence);

// The same drawn as a smooth curve over steps: x counts steps from `first_step`. `take_share` of
// the deviation is a constant of the whole take, as an actor starts each passage a little
// differently.
ApproximatingCurve step_variation(Deviates deviates, int first_step, int steps, double persistence,
                                  double take_share);

}  // namespace gait
