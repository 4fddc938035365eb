// A display that nobody sees, with Pd's windows on it, and what is drawn there.
#pragma once

#include <sys/types.h>

#include <array>
#include <string>

#include "patches/patch.h"

namespace gait::testing {

// Where there is an Xvfb to be had, and a Pd with a window.
bool has_screen();

class Screen {
 public:
  // Opens a display. The patch is opened in Pd with its window and without sound.
  explicit Screen(const Patch& patch);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  // How many dots of just this colour (red, green, blue; 0 to 255) are to be seen now.
  int dots(std::array<int, 3> colour) const;
  // Waits until there are so many, half a minute at most, and says how many there are then.
  int wait_for_dots(std::array<int, 3> colour, int least) const;
  std::string log() const;  // Pd's console so far

 private:
  std::string folder_;
  pid_t display_ = -1, pd_ = -1;
};

}  // namespace gait::testing
