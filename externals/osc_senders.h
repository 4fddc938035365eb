// Who sends to [gait.osc], and from whom its performers come.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gait/osc/frame_gatherer.h"
#include "pd/background.h"
#include "pd/outlet.h"

namespace gait::pd {

class OscSenders {
 public:
  explicit OscSenders(Box& box) : box_(box) {}
  void set_blocking() { background_.set_blocking(true); }

  // `from HOST [PORT]`: performers come from there alone; `from` alone: from everywhere.
  // `performer`: which one, -1: all. The worker looks a name up, which may take seconds.
  void from(const Arguments& arguments, int performer);
  // A new gatherer takes over what was chosen.
  void use(osc::FrameGatherer* gatherer);
  // The messages that restore what was chosen.
  void dump(Outlet& info) const;

  // `sender ADDRESS FORM RATE BONES PERFORMER` for each one that sends now.
  void list(double now, Outlet& info) const;
  // Says once of each sender that is no performer that it is not, and how it can be.
  void tell_left_out(double now);

 private:
  struct Choice {
    int performer;
    std::string host;
    int port;
    std::vector<UdpAddress> addresses;
  };
  void apply() const;

  Box& box_;
  osc::FrameGatherer* gatherer_ = nullptr;
  std::vector<Choice> choices_;
  std::vector<UdpAddress> told_;  // left out
  int lookups_ = 0;               // `from` raises it: look-ups begun before add nothing
  Background background_;
};

}  // namespace gait::pd
