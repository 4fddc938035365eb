#include "gait/motion/unit_guess.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "gait/error.h"
#include "gait/motion/contacts.h"
#include "gait/numbers.h"

namespace gait {

namespace {

struct Unit {
  std::string_view name;
  double metres;
  double share;  // of files, roughly
};

// The usual ones first. MakeHuman writes decimetres; CMU's own files are in units of 1/0.45 inch.
constexpr std::size_t usual_units = 4;
constexpr double usual_share = 0.06;
constexpr std::array<Unit, 7> units{{{"m", 1, 0.2},
                                     {"cm", 0.01, 0.5},
                                     {"mm", 0.001, 0.07},
                                     {"in", 0.0254, 0.15},
                                     {"ft", 0.3048, 0.02},
                                     {"dm", 0.1, 0.03},
                                     {"cmu", 0.0254 / 0.45, 0.05}}};

// Thigh and shank of a grown person (m), and its spread in logarithms.
constexpr double usual_leg = 0.83, leg_spread = 0.075;
// Characters that are drawn differ more.
constexpr double drawn_share = 0.03, drawn_spread = 0.3;
// Children from five years on, and fewer the younger.
constexpr double children_share = 0.1, leg_at_five = 0.5, leg_at_twelve = 0.72, least_leg = 0.24;
constexpr double rarer_when_younger = 3.3;
// CMU captured grown people.
constexpr double children_in_cmu = 0.05;
// Spread of walkers about their natural frequency, in logarithms: the elderly step half as often
// again, drawn figures still more.
constexpr double tempo_spread = 0.2;
// Height over thigh and shank, 0.245 and 0.246 of it (Drillis and Contini 1966): for rigs whose
// legs have no names.
constexpr double height_over_leg = 2.04;

// In nats: a unit that is this much less likely is out of the question. Children are rare, so one
// is doubted sooner.
constexpr double no_rival = 2.6, no_rival_of_child = 2.9;
// Legs that some person has; in units that few files are in, that a grown one has.
constexpr double longest_leg = 1.15, least_grown_leg = 0.6;

double normal(double z, double spread) {
  return std::exp(-z * z / (2 * spread * spread)) / (spread * std::sqrt(2 * std::numbers::pi));
}

// Density of legs over the logarithm of their length.
double density_of_leg(double metres, const Unit& unit) {
  const double z = std::log(metres / usual_leg);
  double children = 0;
  if (metres > least_leg && metres < leg_at_twelve)
    children = children_share * std::pow(std::min(1.0, metres / leg_at_five), rarer_when_younger);
  if (unit.name == "cmu") children *= children_in_cmu;
  return (1 - children_share - drawn_share) * normal(z, leg_spread) +
         drawn_share * normal(z, drawn_spread) + children;
}

struct Candidate {
  const Unit* unit;
  double metres;  // of the leg
  double score;   // log of prior and likelihood
};

// Best first.
std::vector<Candidate> candidates_for(double leg, const std::optional<WalkTempo>& tempo) {
  std::vector<Candidate> candidates;
  for (const Unit& unit : units) {
    const double metres = leg * unit.metres;
    double score = std::log(unit.share) + std::log(density_of_leg(metres, unit) + 1e-300);
    if (tempo) {
      const double z =
          std::log(tempo->frequency / natural_frequency(tempo->speed_per_leg, metres)) /
          tempo_spread;
      score -= std::min(z * z / 2, 8.0);
    }
    candidates.push_back({&unit, metres, score});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  return candidates;
}

std::string told(double value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                 std::chars_format::general, 3);
  return {digits.data(), end.ptr};
}

std::string told(const Candidate& candidate) {
  return told(candidate.metres) + " m (" + std::string(candidate.unit->name) + ")";
}

}  // namespace

double metres_per_unit_named(std::string_view unit) {
  for (const Unit& known : units)
    if (known.name == unit) return known.metres;
  const auto metres = number_in(unit);
  if (metres && *metres >= 1e-6 && *metres <= 1e6) return *metres;
  throw Error(
      "expected a unit (m, cm, mm, dm, in, ft, cmu) or metres per unit as a number above zero, "
      "found '" +
      std::string(unit) + "'");
}

bool unit_is_open(double leg) {
  const std::vector<Candidate> candidates = candidates_for(leg, std::nullopt);
  return candidates[1].score > candidates[0].score - 3 * no_rival;
}

UnitGuess unit_of_leg(double leg, const std::optional<WalkTempo>& tempo) {
  const std::vector<Candidate> candidates = candidates_for(leg, tempo);
  const Candidate& best = candidates[0];
  UnitGuess guess{best.unit->metres, ""};
  const std::string taken = "; taking " + std::string(best.unit->name);
  if (candidates[1].score >
      best.score - (best.metres < least_grown_leg ? no_rival_of_child : no_rival))
    guess.doubt = "the unit is doubtful, as a leg of " + told(leg) + " units may be " + told(best) +
                  " or " + told(candidates[1]) + taken + " (say --unit " +
                  std::string(best.unit->name) + " or --unit " +
                  std::string(candidates[1].unit->name) + ")";
  else if (best.metres > longest_leg ||
           best.metres < (best.unit->share < usual_share ? least_grown_leg : least_leg))
    guess.doubt = "the unit is doubtful, as a leg of " + told(leg) + " units fits none well" +
                  taken + ", " + told(best.metres) +
                  " m of leg (say --unit m, cm, mm, in, ft or metres per unit)";
  return guess;
}

UnitGuess unit_of_height(double height) {
  const auto far = [&](const Unit& unit) {
    return std::abs(std::log(height / height_over_leg * unit.metres / usual_leg));
  };
  const Unit& best =
      *std::min_element(units.begin(), units.begin() + usual_units,
                        [&](const Unit& a, const Unit& b) { return far(a) < far(b); });
  return {best.metres, "the unit is doubtful, as no legs are known and a body of " + told(height) +
                           " units fits none well; taking " + std::string(best.name) + ", " +
                           told(height / height_over_leg * best.metres) +
                           " m of leg (say --unit m, cm, mm, in, ft or metres per unit)"};
}

}  // namespace gait
