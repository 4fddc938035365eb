// Frame source: the frames of one skeleton or user of one sender, and what is known of it: how
// often and how evenly they come, and which bones.
#pragma once

#include <array>
#include <bitset>

#include "gait/osc/captured_frame.h"

namespace gait::osc {

// What a source carries, from little to much: a greater one is preferred.
enum class Carried { nothing, face, upper_body, body };

class FrameSource {
 public:
  static constexpr double lately = 1.0;  // seconds, for which what was told counts

  // Begins anew, as the source of this event.
  void begin(const MocapEvent& event) noexcept;
  // Goes on under the event's port. `again`: it is a restart, maybe of another rig.
  void change_port(const MocapEvent& event, bool again) noexcept;
  void release() noexcept { used_ = false; }

  bool used() const noexcept { return used_; }
  bool is_of(const MocapEvent& event) const noexcept;      // but for the port
  bool is_sender(const MocapEvent& event) const noexcept;  // of whatever skeleton
  double first() const noexcept { return first_; }         // arrival of its first event
  double seen() const noexcept { return seen_; }           // of its last event
  int frames() const noexcept { return frames_; }
  bool hopping() const noexcept { return hopping_; }  // takes another port for every frame
  void set_hopping(bool hopping) noexcept { hopping_ = hopping; }
  bool had_port(std::uint16_t port) const noexcept;  // lately
  // Whether frames have stopped, for longer than they ever pause while they come.
  bool paused(double now) const noexcept;

  // Seconds after which an open frame ends. A sender that says when its frames end may be held up
  // in the midst of one, so it gets longer.
  double patience(double now) const noexcept { return says_ends(now) ? 0.05 : 0.01; }
  // Whether the event ends the frame before it is taken.
  bool ends_before(const MocapEvent& event) const noexcept;
  // False: there is no room for a joint.
  bool take(const MocapEvent& event) noexcept;
  // For clocks and edges: whether the frame ends.
  bool take_edge(const MocapEvent& event) noexcept;
  // The frame has ended and is not empty.
  void count_frame() noexcept;
  // The frame has ended, empty or not: the next one begins.
  void begin_next() noexcept;
  CapturedFrame& frame() noexcept { return frame_; }
  const CapturedFrame& frame() const noexcept { return frame_; }

  // Frames per second, 0 when it is not known; the interval that 95 % of the intervals stay below,
  // as a multiple of the usual one.
  double rate() const noexcept;
  double uneven() const noexcept;
  // The bones that came lately.
  std::bitset<humanoid_bones> bones() const noexcept { return bones_ | bones_before_; }
  Carried carries() const noexcept;

 private:
  static constexpr int most_times = 64;
  bool says_ends(double now) const noexcept;

  bool used_ = false, hopping_ = false, clocked_ = false, again_ = false;
  double first_ = 0, seen_ = 0, edge_seen_ = -1e9, bones_since_ = 0;
  int frames_ = 0, frames_of_port_ = 0, values_ = 0;
  std::array<std::uint16_t, 8> ports_{};  // before this one
  MocapEvent first_told_;                 // of the frame
  bool any_told_ = false;
  CapturedFrame frame_;
  std::bitset<humanoid_bones> bones_, bones_before_;
  std::array<double, most_times> times_{};
};

}  // namespace gait::osc
