// The unit of a file, from the length of its body's leg (thigh + shank) and from how it walks.
//
// Grown people's legs leave hardly a doubt. A child's leg in inches is a giant's in CMU's unit, a
// toddler's in centimetres an adult's in inches: then it counts which units files are written in,
// how many people have such legs, and that short legs swing faster (natural_frequency).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gait {

// "m", "cm", "mm", "dm", "in", "ft", "cmu" (1/0.45 inch, in which CMU wrote its files) or a number:
// metres per unit. Throws Error for others.
double metres_per_unit_named(std::string_view unit);

// How a body walks, whatever the unit.
struct WalkTempo {
  double frequency = 0;      // cycles per second
  double speed_per_leg = 0;  // leg lengths per second
};

struct UnitGuess {
  double metres_per_unit = 0.01;
  std::string doubt;  // what is doubtful, and the flag that settles it; empty: nothing
};

// `leg` in the file's unit, above zero. `tempo`: of a body that walks.
UnitGuess unit_of_leg(double leg, const std::optional<WalkTempo>& tempo);
// Whether the leg alone leaves more than one unit open, so that the tempo counts.
bool unit_is_open(double leg);
// For a body without known legs: the nearest of the usual units. `height` in the file's unit.
UnitGuess unit_of_height(double height);

}  // namespace gait
