// Contacts and steps: when which foot first touches the ground, and what lies between.
//
// A step goes from one foot's contact to the other's and bears the name of the foot that starts
// it; the contact's frame belongs to the new step. A cycle goes from one right contact to the next.
#pragma once

#include <string_view>
#include <vector>

namespace gait {

enum class Foot { right, left };

constexpr std::string_view foot_name(Foot foot) { return foot == Foot::right ? "right" : "left"; }
constexpr Foot other(Foot foot) { return foot == Foot::right ? Foot::left : Foot::right; }

struct Contact {
  int frame = 0;  // the first frame at which the foot touches, or the nearest one
  Foot foot = Foot::right;
  double offset = 0;  // frames from there to the touch itself, between frames: -1 to 0.5

  double seconds(double frame_rate) const { return (frame + offset) / frame_rate; }

  // The same touch, however well it is known when.
  friend bool operator==(const Contact& a, const Contact& b) {
    return a.frame == b.frame && a.foot == b.foot;
  }
};

struct Step {
  int begin = 0, end = 0;  // frames [begin, end)
  Foot foot = Foot::right;
  double offset = 0;  // of the contact that starts it
};

struct Cycle {
  int begin = 0, end = 0;  // frames [begin, end), from right contact to right contact
};

// Steps between neighbouring contacts of different feet.
std::vector<Step> steps_between(const std::vector<Contact>& contacts);

// Cycles that hold right contact, left contact, right contact.
std::vector<Cycle> cycles_between(const std::vector<Contact>& contacts);

}  // namespace gait
