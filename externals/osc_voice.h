// One performer of [gait.osc]: brings captured frames to the model's body, holds them until they
// are due (jitter), and sends them as messages.
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
#include "pd/voice_message.h"

namespace gait::pd {

// Settings of all performers.
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
  // Takes the next frame for that pose, unless it comes late. False, with nothing changed, while no
  // frames come.
  bool calibrate(CalibrationPose pose, double now);
  void reset();
  // Continues another voice, of the same performer on another model, with its calibration. Messages
  // that it has sent are not sent again.
  void take_over(const OscVoice& before);

  // From the gatherer, on Pd's thread; sends nothing.
  void take(const osc::CapturedFrame& frame) noexcept;
  // Sends a frame if one is due. It sends one at a time, because receivers tell frames apart by
  // their times, and a network may deliver several at once. `now`: seconds on the clock of
  // arrivals. `latency` gets the time from the frame's arrival to its leaving.
  void release(double now, Outlet& in, Outlet& pose, Outlet& info, Perf& perf, Latency& latency);
  // At every tick: sends `rate` once a second, and `stream 0` when the stream has ended.
  void report(double now, Outlet& info);
  // Ends the stream: [gait.osc] listens to it no longer.
  void end(Outlet& info);
  // Frames of values of another count than the model's, and those the jitter buffer had no room
  // for.
  int dropped() const { return unfit_ + waiting_.lost(); }

 private:
  VoiceMessage to(Outlet& outlet, const char* selector) { return {outlet, number_, selector}; }
  void send_masks(Outlet& in, std::span<const float> there);
  void send_sender(Outlet& info);

  std::shared_ptr<const Model> model_;
  int number_;
  double hold_ = 0.5;
  osc::LiveBody body_;
  osc::JitterBuffer waiting_;
  std::vector<float> packed_;
  std::vector<bool> there_;  // of each input, as `mask` said last; at first all are there
  std::size_t inputs_, pose_;
  bool changed_sender_ = false, flowing_ = false, said_flowing_ = false;
  UdpAddress sender_;
  std::uint32_t stream_ = 0;
  osc::MocapForm form_ = osc::MocapForm::none;
  double last_ = 0, rate_from_ = 0;
  int counted_ = 0, unfit_ = 0;
};

}  // namespace gait::pd
