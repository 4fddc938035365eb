// gait listen: live motion that comes over OSC, recorded as a BVH file.
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <thread>

#include "commands.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/files/whole_file.h"
#include "gait/osc/forms.h"
#include "gait/osc/frame_gatherer.h"
#include "gait/osc/receiver.h"
#include "gait/osc/recording.h"
#include "interrupt.h"
#include "option_kinds.h"

namespace gait::tool {

namespace {

constexpr auto poll_interval = std::chrono::milliseconds(2);

struct ListenOptions {
  int port = 39539;
  std::string output, form;
  std::optional<double> seconds;
  bool any = false;
};

class Recorder final : public osc::FrameSink {
 public:
  void frame(int, const osc::CapturedFrame& frame) noexcept override {
    if (frame.values > 0) values_only = true;
    if (recording.frames() == 0) first = frame.form;
    recording.add(frame);
  }
  osc::Recording recording;
  osc::MocapForm first = osc::MocapForm::none;
  bool values_only = false;
};

void listen(const ListenOptions& options) {
  const Interrupt interrupt;
  WholeFile output(options.output);
  osc::Receiver receiver(
      {.port = options.port,
       .any = options.any,
       .form = options.form.empty() ? osc::MocapForm::none : *osc::form_named(options.form)});
  std::fprintf(stderr, "gait listen: on port %d, until %sCtrl-C\n", receiver.port(),
               options.seconds ? "the time is up or " : "");
  osc::FrameGatherer gatherer(1);
  Recorder recorder;
  osc::MocapEvent event;
  const auto begin = std::chrono::steady_clock::now();
  while (!interrupt.requested()) {
    while (receiver.pop(event)) gatherer.take(event, recorder);
    gatherer.end_old(osc::Receiver::now(), recorder);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    if (options.seconds && passed.count() >= *options.seconds) break;
    std::this_thread::sleep_for(poll_interval);
  }
  gatherer.end_old(1e300, recorder);
  const osc::Received received = receiver.received();
  const osc::Recording& recording = recorder.recording;
  if (recording.frames() == 0) {
    const std::string port = "port " + std::to_string(receiver.port());
    if (recorder.values_only)
      throw Error(port + ": only values of a model came (/gait/frame), which have no rig; send " +
                  "with --form gait or vmc");
    throw Error(port + ": expected a body's motion, got " + std::to_string(received.packets) +
                " packets and no frame");
  }
  const unsigned long long dropped = received.dropped + gatherer.refused();
  if (dropped > 0 || received.faulty > 0)
    std::fprintf(stderr, "gait listen: warning: %llu events were dropped, %llu messages faulty\n",
                 dropped, static_cast<unsigned long long>(received.faulty));
  const Clip clip = recording.clip(options.output);
  write_bvh(bvh_from_clip(clip), output.part());
  output.keep();
  std::printf("%d frames at %g per second, %d joints, form %s\n", clip.frames(), clip.frame_rate,
              clip.skeleton.size(), std::string(osc::form_name(recorder.first)).c_str());
}

void add_options(CLI::App& app, ListenOptions& options) {
  add_argument(app, "PORT", options.port, "Port to listen on")->check(within(1, 65535));
  add_output(app, "BVH", options.output, "BVH file to write, in metres");
  add_value(app, "--seconds", "S", options.seconds, "How long to listen (until Ctrl-C)")
      ->check(within(0.1, 36000));
  add_choice(app, "--form", osc::form_names(), options.form,
             "Read only this form (whichever comes): " + osc::form_names_text());
  app.add_flag("--any", options.any, "Receive from other machines too, not only from this one")
      ->default_str("");
  app.footer(R"(Examples:
  gait listen 39539 -o take.bvh --seconds 30
  gait listen 39539 -o take.bvh --any)");
}

}  // namespace

Command listen_command(CLI::App& program) {
  return make_command(program, "listen", "Record live motion that comes over OSC", add_options,
                      listen);
}

}  // namespace gait::tool
