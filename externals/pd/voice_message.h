// A message out of a box with one performer or several (-poly), whose messages then begin with the
// performer's number.
#pragma once

#include "pd/outlet.h"

namespace gait::pd {

inline constexpr int most_voices = 64;  // performers in one box

class VoiceMessage {
 public:
  // `number`: of the performer, -1: the box has only one.
  VoiceMessage(Outlet& outlet, int number, const char* selector)
      : outlet_(outlet), selector_(number < 0 ? selector : "list") {
    if (number >= 0) outlet.add(number).add(selector);
  }
  template <class Value>
  VoiceMessage& add(const Value& value) {
    outlet_.add(value);
    return *this;
  }
  VoiceMessage& add_text(const std::string& text) {
    outlet_.add_text(text);
    return *this;
  }
  void send() { outlet_.send(selector_); }

 private:
  Outlet& outlet_;
  const char* selector_;
};

}  // namespace gait::pd
