// One performer of [gait.osc]: what came of him, brought to the model's body, waits here until it
// is due and leaves as messages.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gait/osc/jitter_buffer.h"
#include "gait/osc/live_body.h"
#include "osc_latency.h"
#include "pd/outlet.h"
#include "pd/perf.h"

namespace gait::pd {

// What messages set, for all performers.
struct OscSettings {
  double yaw = 0;     // degrees
  double jitter = 0;  // ms
  double hold = 0.5;  // s
  double smooth = 0;  // Hz
};

class OscVoice {
 public:
  // `number`: which performer, -1: the only one.
  OscVoice(std::shared_ptr<const Model> model, int number, const OscSettings& settings);

  void set(const OscSettings& settings);
  // The next frame is that pose, unless it is late. False, with nothing changed, while nobody
  // sends.
  bool calibrate(CalibrationPose pose, double now);
  void reset();
  // The same performer as that one, of another model: calibrated as he was, what was told is told.
  void take_over(const OscVoice& before);

  // From the gatherer, on Pd's thread; sends nothing.
  void take(const osc::CapturedFrame& frame) noexcept;
  // Sends a frame if one is due: one at a time, for who takes it tells frames apart by when they
  // come, and a network may hand over several at once. `now`: seconds on the clock of arrivals.
  // `latency`: from a frame's arrival to its leaving.
  void release(double now, Outlet& in, Outlet& pose, Outlet& info, Perf& perf, Latency& latency);
  // A tick of the clock: whether the stream flows, at what rate.
  void report(double now, Outlet& info);
  // Nobody listens to him any longer.
  void end(Outlet& info);
  // Frames of values of another count than the model's, and those the jitter buffer had no room
  // for.
  int dropped() const { return unfit_ + waiting_.lost(); }

 private:
  Outlet& begin(Outlet& outlet, const char* selector);
  void send(Outlet& outlet, const char* selector);
  void send_masks(Outlet& in, std::span<const float> there);
  void send_sender(Outlet& info);

  std::shared_ptr<const Model> model_;
  int number_;
  double hold_ = 0.5;
  osc::LiveBody body_;
  osc::JitterBuffer waiting_;
  std::vector<float> packed_;
  std::vector<bool> there_;  // inputs, as was told last; at first everybody takes them to be there
  std::size_t inputs_, pose_;
  bool changed_sender_ = false, flowing_ = false, said_flowing_ = false;
  std::uint64_t sender_ = 0;
  std::uint32_t stream_ = 0;
  osc::MocapForm form_ = osc::MocapForm::none;
  double last_ = 0, rate_from_ = 0;
  int counted_ = 0, unfit_ = 0;
};

}  // namespace gait::pd
