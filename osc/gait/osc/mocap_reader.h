// Mocap reader: recognises the form of a message with motion and converts it to events. Unknown
// messages are skipped; a message with too few arguments, with wrong types or with numbers that are
// not finite is faulty as a whole.
#pragma once

#include <array>
#include <cstdint>

#include "gait/osc/mocap_event.h"
#include "gait/osc/osc_message.h"

namespace gait::osc {

enum class Reading { taken, unknown, faulty };

// Data that all events of a message share.
struct Arrival {
  double time = 0;           // seconds
  std::uint64_t sender = 0;  // address and port
};

// Bones by number, from the names that a NatNet bridge sent for its numbers. The table has a fixed
// size and replaces its oldest entries.
class BoneNumbers {
 public:
  void set(std::uint32_t skeleton, int number, int bone) noexcept;
  // Returns -1 for an unknown bone. Uses Motive's usual numbering when no name was sent.
  int bone(std::uint32_t skeleton, int number) const noexcept;

 private:
  struct Entry {
    std::uint32_t skeleton = 0;
    int number = -1, bone = -1;
  };
  std::array<Entry, 512> entries_;
  std::size_t next_ = 0;
};

class MocapReader {
 public:
  // `form`: the only form to read; none: every known one.
  explicit MocapReader(MocapForm form = MocapForm::none) : form_(form) {}

  Reading read(const OscMessage& message, const Arrival& arrival, EventSink& sink);

 private:
  MocapForm form_;
  BoneNumbers bone_numbers_;
};

// Readers of the forms, one file each. They recognise their messages by the address.
Reading read_vmc(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_natnet(const OscMessage& message, const Arrival& arrival, BoneNumbers& numbers,
                    EventSink& sink);
Reading read_neuron(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_kinect(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_gait(const OscMessage& message, const Arrival& arrival, EventSink& sink);

// An event with the data that all events have.
MocapEvent event_of(MocapKind kind, MocapForm form, const Arrival& arrival);
// Reads four numbers from `first` on as a rotation; returns false when they are missing or near
// zero.
bool rotation_in(const OscMessage& message, int first, MocapEvent& event);

}  // namespace gait::osc
