// Mocap reader: recognises the form of a message or datagram and has it read. Unknown ones are
// skipped; one with too few arguments, with wrong types or with numbers that are not finite is
// faulty as a whole.
#pragma once

#include <memory>
#include <vector>

#include "gait/osc/form_reader.h"

namespace gait::osc {

class MocapReader {
 public:
  // `form`: the only form to read; none: every known one.
  explicit MocapReader(MocapForm form = MocapForm::none);

  Reading read(const OscMessage& message, const Arrival& arrival, EventSink& sink);
  // A datagram that is not OSC.
  Reading read(std::span<const std::byte> datagram, const Arrival& arrival, EventSink& sink);

 private:
  std::vector<std::unique_ptr<FormReader>> readers_;
};

}  // namespace gait::osc
