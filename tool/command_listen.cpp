// gait listen: live motion that comes over the network, watched or recorded as a BVH file.
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <thread>

#include "commands.h"
#include "gait/error.h"
#include "gait/files/bvh.h"
#include "gait/osc/forms.h"
#include "gait/osc/frame_gatherer.h"
#include "gait/osc/receiver.h"
#include "gait/osc/recording.h"
#include "gait/platform/path_text.h"
#include "gait/platform/whole_file.h"
#include "interrupt.h"
#include "live_monitor.h"
#include "option_kinds.h"

namespace gait::tool {

namespace {

constexpr auto poll_interval = std::chrono::milliseconds(2);
constexpr int most_monitored = 32;  // senders

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
    bones |= frame.rotated | frame.placed;
    recording.add(frame);
  }
  void plain(const osc::MocapEvent&) { plain_only = true; }
  osc::Recording recording;
  osc::MocapForm first = osc::MocapForm::none;
  std::bitset<humanoid_bones> bones;
  bool values_only = false, plain_only = false;
};

// Why there is nothing to write.
std::string no_body(const Recorder& recorder, const osc::Receiver& receiver) {
  const std::string port = "port " + std::to_string(receiver.port());
  if (recorder.values_only)
    return port +
           ": only values of a model came (/gait/frame), which have no rig; send with "
           "--form gait or vmc";
  if (recorder.bones.any())
    return port + ": expected the bone Hips, on which a body hangs, got without it: " +
           bone_list(recorder.bones) + " (form " + std::string(osc::form_name(recorder.first)) +
           "); does the sender track a whole body?";
  if (recorder.plain_only)
    return port + ": only streams of plain numbers came, as phones send them: they move no body";
  if (const std::string_view notice = receiver.notice(); !notice.empty())
    return port + ": " + std::string(notice);
  return port + ": expected a body's motion, got " + std::to_string(receiver.received().packets) +
         " packets and no frame" + receiver.unknown_addresses();
}

// Gives what comes to the sink until it is enough. `each_second` is called about once a second.
template <class Sink, class EachSecond>
void hear(const ListenOptions& options, const Interrupt& interrupt, osc::Receiver& receiver,
          osc::FrameGatherer& gatherer, Sink& sink, EachSecond each_second) {
  std::fprintf(stderr, "gait listen: on port %d, until %sCtrl-C\n", receiver.port(),
               options.seconds ? "the time is up or " : "");
  osc::MocapEvent event;
  const double begin = osc::Receiver::now();
  double second = begin + 1;
  while (!interrupt.requested()) {
    while (receiver.pop(event)) {
      if (event.kind == osc::MocapKind::plain) sink.plain(event);
      gatherer.take(event, sink);
    }
    const double now = osc::Receiver::now();
    gatherer.end_old(now, sink);
    if (now >= second) each_second(now), second += 1;
    if (options.seconds && now - begin >= *options.seconds) break;
    std::this_thread::sleep_for(poll_interval);
  }
  gatherer.end_old(1e300, sink);
}

void listen(const ListenOptions& options) {
  const Interrupt interrupt;  // before the receiver's thread
  std::optional<WholeFile> output;
  if (!options.output.empty()) output.emplace(path_from_utf8(options.output));
  osc::Receiver receiver(
      {.port = options.port,
       .any = options.any,
       .form = options.form.empty() ? osc::MocapForm::none : *osc::form_named(options.form)});
  if (!output) {
    osc::FrameGatherer gatherer(most_monitored);
    LiveMonitor monitor;
    hear(options, interrupt, receiver, gatherer, monitor, [&](double now) {
      for (const std::string& line : monitor.lines(now, gatherer, receiver))
        std::printf("%s\n", line.c_str());
      std::fflush(stdout);
    });
    return;
  }
  osc::FrameGatherer gatherer(1);
  Recorder recorder;
  hear(options, interrupt, receiver, gatherer, recorder, [](double) {});
  const osc::Received received = receiver.received();
  const osc::Recording& recording = recorder.recording;
  if (recording.frames() == 0) throw Error(no_body(recorder, receiver));
  const unsigned long long dropped = received.dropped + gatherer.refused();
  if (dropped > 0 || received.faulty > 0)
    std::fprintf(stderr, "gait listen: warning: %llu events were dropped, %llu messages faulty\n",
                 dropped, static_cast<unsigned long long>(received.faulty));
  const Clip clip = recording.clip(options.output);
  write_bvh(bvh_from_clip(clip), output->part());
  output->keep();
  std::printf("%d frames at %g per second, %d joints, form %s\n", clip.frames(), clip.frame_rate,
              clip.skeleton.size(), std::string(osc::form_name(recorder.first)).c_str());
}

void add_options(CLI::App& app, ListenOptions& options) {
  add_argument(app, "PORT", options.port, "Port to listen on")->check(within(1, 65535));
  add_value(app, "-o,--output", "BVH", options.output,
            "BVH file to write, in metres; without it, who sends what is printed each second");
  add_value(app, "--seconds", "S", options.seconds, "How long to listen (until Ctrl-C)")
      ->check(within(0.1, 36000));
  add_choice(app, "--form", osc::form_names(), options.form,
             "Read only this form (whichever comes): " + osc::form_names_text());
  app.add_flag("--any", options.any, "Receive from other machines too, not only from this one")
      ->default_str("");
  app.footer(R"(Examples:
  gait listen 39539
  gait listen 39539 -o take.bvh --seconds 30
  gait listen 39539 -o take.bvh --any)");
}

}  // namespace

Command listen_command(CLI::App& program) {
  return make_command(program, "listen", "Watch or record live motion that comes over the network",
                      add_options, listen);
}

}  // namespace gait::tool
