// Live monitor: what `gait listen` without -o prints each second: who sends what form, which bones,
// how fast and how evenly, and what looks wrong.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gait/osc/frame_gatherer.h"
#include "gait/osc/receiver.h"

namespace gait::tool {

// "Hips, Spine, Head"
std::string bone_list(const std::bitset<humanoid_bones>& bones);

class LiveMonitor final : public osc::FrameSink {
 public:
  void frame(int performer, const osc::CapturedFrame& frame) noexcept override;
  void plain(const osc::MocapEvent& event);
  // Lines for stdout. `now`: on the clock of arrivals.
  std::vector<std::string> lines(double now, const osc::FrameGatherer& gatherer,
                                 const osc::Receiver& receiver);

 private:
  struct Seen {  // of a performer
    double moved = 0, placed = -1e9, first = 0, last = 0, longest = 0;
    std::array<std::array<float, 4>, humanoid_bones> rotations{};
    std::array<std::array<float, 3>, humanoid_bones> places{};
  };
  std::vector<std::string> doubts(double now, const osc::FrameSource& source, const Seen& seen);

  std::map<int, Seen> seen_;
  std::map<std::string, std::string> told_bones_;  // per sender
  std::map<std::string, int> plain_;               // numbers of streams of this second
  osc::Received before_;
  bool waiting_told_ = false;
};

}  // namespace gait::tool
