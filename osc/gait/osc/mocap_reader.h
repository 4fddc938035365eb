// Mocap reader: tells the forms in which motion is sent apart, and turns each message into events.
// What it does not know it passes over; a message with too few arguments, of wrong types or with
// numbers that are not finite is faulty as a whole.
#pragma once

#include <array>
#include <cstdint>

#include "gait/osc/mocap_event.h"
#include "gait/osc/osc_message.h"

namespace gait::osc {

enum class Reading { taken, unknown, faulty };

// What of a message all events made from it share.
struct Arrival {
  double time = 0;           // seconds
  std::uint64_t sender = 0;  // address and port
};

// Bones by the names that a NatNet bridge told for its numbers. Bounded: the oldest are forgotten.
class BoneNumbers {
 public:
  void set(std::uint32_t skeleton, int number, int bone) noexcept;
  // -1: not a bone of ours. Without a name, Motive's usual numbering.
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
  // `form`: read only this; none: every one that is recognised.
  explicit MocapReader(MocapForm form = MocapForm::none) : form_(form) {}

  Reading read(const OscMessage& message, const Arrival& arrival, EventSink& sink);

 private:
  MocapForm form_;
  BoneNumbers bone_numbers_;
};

// One file each. They tell by the address whether a message is theirs.
Reading read_vmc(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_natnet(const OscMessage& message, const Arrival& arrival, BoneNumbers& numbers,
                    EventSink& sink);
Reading read_neuron(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_kinect(const OscMessage& message, const Arrival& arrival, EventSink& sink);
Reading read_gait(const OscMessage& message, const Arrival& arrival, EventSink& sink);

// An event with what all have.
MocapEvent event_of(MocapKind kind, MocapForm form, const Arrival& arrival);
// Four numbers from `first` on as a rotation; false when they are missing or near zero.
bool rotation_in(const OscMessage& message, int first, MocapEvent& event);

}  // namespace gait::osc
