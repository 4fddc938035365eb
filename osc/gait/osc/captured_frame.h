// Captured frame: all that one performer's frame contains.
#pragma once

#include <array>
#include <bitset>
#include <vector>

#include "gait/motion/humanoid.h"
#include "gait/osc/mocap_event.h"

namespace gait::osc {

inline constexpr int most_joints = 256;   // of a rig with its own names
inline constexpr int most_values = 1024;  // of a frame of values

// A joint identified by its own name.
struct NamedJoint {
  std::array<char, MocapEvent::name_size> name{}, parent{};
  int above = -1;  // the parent's index among the named joints, -1: none or not known
  bool rigged = false;
  std::array<float, 3> offset{};
  bool rotated = false, placed = false, relative = false;  // in this frame
  std::array<float, 4> rotation{0, 0, 0, 1};
  std::array<float, 3> vector{};  // relative
  std::array<float, 3> place{};
};

// One frame of one performer, in the sender's axes and metres. Rotations, places and numbers that
// the frame did not contain keep the values of the frame before.
struct CapturedFrame {
  MocapForm form = MocapForm::none;
  UdpAddress sender;
  std::uint32_t stream = 0;
  bool begun = false;      // the sender's first frame, or the first since it changed its port
  double time = 0;         // arrival of the first event of the frame, seconds
  double sent = not_sent;  // by the sender's clock, in its unit
  std::bitset<humanoid_bones> rotated, placed;
  std::array<std::array<float, 4>, humanoid_bones> rotations;
  std::array<std::array<float, 3>, humanoid_bones> places;
  bool root_told = false;
  std::array<float, 3> root{};
  std::array<float, 4> root_rotation{0, 0, 0, 1};
  float heading = 0;  // own form
  int values = 0;     // how many there are
  std::array<float, most_values> numbers{};
  int joints = 0;  // named ones known so far
  bool rig_changed = false;
  std::vector<NamedJoint> named;

  CapturedFrame();
  void begin(double at) noexcept;  // clears the marks of what the frame contains
  bool empty() const noexcept;

  // Takes what an event tells. Returns false when there is no room for a joint.
  bool take(const MocapEvent& event) noexcept;
  // Whether the frame contains what the event tells.
  bool contains(const MocapEvent& event) const noexcept;

 private:
  bool take_joint(const MocapEvent& event) noexcept;
};

}  // namespace gait::osc
