// Mocap event: one item of a message with motion. It has a fixed size, so that it passes from the
// receiving thread to the playing one without allocation.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "gait/platform/udp_address.h"

namespace gait::osc {

// The forms, in the order of the table in forms.cpp.
enum class MocapForm : std::uint8_t {
  none,
  vmc,
  natnet,
  neuron,
  kinect,
  mocopi,
  mvn,
  rokoko,
  mediapipe,
  trackers,
  phone,
  wekinator,
  gait
};

inline constexpr double not_sent = std::numeric_limits<double>::quiet_NaN();

enum class MocapKind : std::uint8_t {
  bone,    // a humanoid's bone: place, rotation or both
  root,    // the root of the body: place and rotation (own form: place and heading)
  joint,   // a joint by its own name (own form)
  rig,     // a joint's parent and offset (own form)
  values,  // some values of a frame (own form)
  plain,   // numbers of a stream that moves no body, with its name
  clock,   // the sender's clock, of the frame that ends next
  notice,  // something that the user should know: `first` is a Notice
  edge     // a frame has ended; with the sender's clock where it is told together with that
};

enum class Notice : std::int16_t { none, rokoko_compressed };

struct MocapEvent {
  static constexpr std::size_t name_size = 40;    // longer names are no joints
  static constexpr std::size_t most_numbers = 7;  // values in one event

  MocapKind kind = MocapKind::edge;
  MocapForm form = MocapForm::none;
  bool placed = false, rotated = false;
  bool relative = false;     // joint: a rotation vector relative to the model's reference
  std::int16_t bone = -1;    // index of a humanoid's bone
  std::int16_t first = 0;    // values, plain: index of the first
  std::int16_t count = 0;    // values, plain: how many
  std::int16_t total = 0;    // plain: how many the stream has
  std::uint32_t stream = 0;  // which skeleton or user of this sender
  UdpAddress sender;
  double time = 0;         // of arrival, seconds on a steady clock
  double sent = not_sent;  // clock and edge: seconds (or thousandths) on the sender's own clock
  // In the sender's own axes and metres; quaternions x y z w of length one.
  std::array<float, 3> place{};
  std::array<float, 4> rotation{0, 0, 0, 1};
  std::array<float, most_numbers> numbers{};
  std::array<char, name_size> name{}, parent{};
};
static_assert(std::is_trivially_copyable_v<MocapEvent>);

// Consumer of events; called on the reading thread.
class EventSink {
 public:
  virtual ~EventSink() = default;
  virtual void take(const MocapEvent& event) = 0;
};

}  // namespace gait::osc
