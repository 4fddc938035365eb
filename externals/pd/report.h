// Errors that every frame may repeat: printed once a second at most, with their count.
#pragma once

#include <m_pd.h>

#include <string>

#include "pd/box.h"

namespace gait::pd {

class SlowError {
 public:
  explicit SlowError(Box& box) : box_(box) {}

  // `text()` makes the line that follows the box's name; it is called only when the line is
  // printed.
  template <class Text>
  void say(Text text) {
    ++unsaid_;
    if (said_ >= 0 && clock_gettimesince(said_) < 1000) return;
    std::string line = text();
    if (unsaid_ > 1) line += " (" + std::to_string(unsaid_) + " times since it was said last)";
    complain(box_, line);
    said_ = clock_getlogicaltime();
    unsaid_ = 0;
  }

 private:
  Box& box_;
  double said_ = -1;
  int unsaid_ = 0;
};

}  // namespace gait::pd
