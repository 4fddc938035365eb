// Frame gatherer: gathers the events of each performer into frames.
//
// A frame ends with the sender's message that ends it, with the second value of a bone that it
// already has, or 10 ms after its first event. Performers are distinguished by the sender's address
// and, within a sender, by skeleton or user. A performer keeps its number until it has been silent
// for a second and another performer needs the slot. Nothing allocates after construction.
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
  std::uint64_t sender = 0;
  std::uint32_t stream = 0;
  double time = 0;  // arrival of the first event of the frame, seconds
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
};

class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual void frame(int performer, const CapturedFrame& frame) noexcept = 0;
};

class FrameGatherer {
 public:
  static constexpr double patience = 0.010;  // seconds after which an open frame ends
  static constexpr double silence = 1.0;     // seconds after which a slot may be reused

  explicit FrameGatherer(int performers);

  void take(const MocapEvent& event, FrameSink& sink) noexcept;
  // Ends frames that have been open for too long. `now`: on the clock of arrivals.
  void end_old(double now, FrameSink& sink) noexcept;

  int performers() const noexcept { return static_cast<int>(slots_.size()); }
  const CapturedFrame& last(int performer) const noexcept { return slots_[performer].frame; }
  // Number of events refused: of performers without a slot, and of joints beyond most_joints.
  std::uint64_t refused() const noexcept { return refused_; }

 private:
  struct Slot {
    bool used = false;
    double seen = 0;
    CapturedFrame frame;
  };
  int slot_of(const MocapEvent& event) noexcept;
  void end(int slot, FrameSink& sink) noexcept;
  void apply(Slot& slot, const MocapEvent& event) noexcept;
  void apply_joint(CapturedFrame& frame, const MocapEvent& event) noexcept;
  bool told_already(const CapturedFrame& frame, const MocapEvent& event) const noexcept;

  std::vector<Slot> slots_;
  std::uint64_t refused_ = 0;
};

}  // namespace gait::osc
