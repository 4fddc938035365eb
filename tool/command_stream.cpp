// gait stream: a clip sent over OSC as a suit would send it, to rehearse without one.
#include <chrono>
#include <optional>
#include <string>
#include <thread>

#include "clip_reader.h"
#include "commands.h"
#include "gait/error.h"
#include "gait/motion/humanoid_body.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/resample.h"
#include "gait/osc/destination.h"
#include "gait/osc/forms.h"
#include "gait/osc/humanoid_sender.h"
#include "gait/osc/rig_sender.h"
#include "gait/platform/path_text.h"
#include "interrupt.h"
#include "option_kinds.h"

namespace gait::tool {

namespace {

struct StreamOptions {
  ClipReading reading;
  std::string input, to, form = "vmc";
  std::optional<double> rate;
  bool loop = false;
};

osc::Destination parse_destination(const std::string& to) {
  const std::size_t colon = to.rfind(':');
  int port = 0;
  try {
    std::size_t read = 0;
    const std::string digits = colon == std::string::npos ? "" : to.substr(colon + 1);
    port = std::stoi(digits, &read);
    if (read != digits.size() || colon == 0) port = 0;
  } catch (const std::exception&) {
    port = 0;
  }
  if (port < 1 || port > 65535)
    throw UsageError("--to " + to + ": expected HOST:PORT with a port from 1 to 65535");
  return {to.substr(0, colon), port};
}

// Makes the packets of one frame after the other.
class FrameTeller {
 public:
  FrameTeller(const Clip& clip, const JointRoles& roles, osc::MocapForm form)
      : clip_(clip), world_(clip.skeleton.joints.size()), places_(world_.size()) {
    if (form == osc::MocapForm::gait) {
      rig_.emplace(clip.skeleton);
      return;
    }
    body_.emplace(clip.skeleton, roles, usual_pose(clip, roles));
    read(0);
    std::vector<int> bones;
    for (int bone = 0; bone < humanoid_bones; ++bone)
      if (pose_.turned[static_cast<std::size_t>(bone)]) bones.push_back(bone);
    humanoid_.emplace(form, bones);
  }

  void send(const osc::Destination& to, int count) {
    const int frame = count % clip_.frames();
    if (rig_) {
      if (count % std::max(1, static_cast<int>(clip_.frame_rate)) == 0) send(to, rig_->rig());
      rig_->pack(clip_.pose(frame), clip_.translation(frame), count);
      send(to, rig_->packets());
    } else {
      read(frame);
      humanoid_->pack(pose_, count / clip_.frame_rate, count);
      send(to, humanoid_->packets());
    }
  }
  int refused() const { return refused_; }

 private:
  void read(int frame) {
    forward_kinematics(clip_.skeleton, clip_.pose(frame), clip_.translation(frame), world_,
                       places_);
    body_->read(world_, places_, pose_);
  }
  template <class Packet>
  void send(const osc::Destination& to, std::span<const Packet> packets) {
    for (const Packet& packet : packets)
      if (!to.send(packet.bytes())) ++refused_;
  }

  const Clip& clip_;
  std::optional<HumanoidBody> body_;
  std::optional<osc::HumanoidSender> humanoid_;
  std::optional<osc::RigSender> rig_;
  HumanoidPose pose_;
  std::vector<Eigen::Quaterniond> world_;
  std::vector<Eigen::Vector3d> places_;
  int refused_ = 0;
};

void stream(const StreamOptions& options) {
  const Interrupt interrupt;
  const osc::Destination to = parse_destination(options.to);
  const ReadClip read = read_clip(path_from_utf8(options.input), options.reading);
  print_doubts("stream", read, false);
  if (read.clip.frames() == 0) throw Error(options.input + ": expected frames, found none");
  const Clip clip = options.rate ? resampled(read.clip, *options.rate) : read.clip;
  FrameTeller teller(clip, read.roles, *osc::form_named(options.form));
  const auto begin = std::chrono::steady_clock::now();
  for (int count = 0; options.loop || count < clip.frames(); ++count) {
    std::this_thread::sleep_until(begin +
                                  std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                      std::chrono::duration<double>(count / clip.frame_rate)));
    if (interrupt.requested()) break;
    teller.send(to, count);
  }
  if (teller.refused() > 0)
    std::fprintf(stderr, "gait stream: warning: the system did not send %d packets\n",
                 teller.refused());
}

void add_options(CLI::App& app, StreamOptions& options) {
  add_argument(app, "IN", options.input, "BVH file");
  add_value(app, "--to", "HOST:PORT", options.to,
            "Where to; avatars listen on port 39539 by custom")
      ->required();
  add_choice(app, "--form", osc::form_names(true), options.form,
             osc::form_names_text(true) + " (the rig as it is)");
  add_value(app, "--rate", "HZ", options.rate, "Frames per second (the clip's)")
      ->check(within(1, 1000));
  app.add_flag("--loop", options.loop, "Again and again, until Ctrl-C")->default_str("");
  add_clip_reading(app, options.reading);
  app.footer(R"(Examples:
  gait stream walk.bvh --to localhost:39539 --loop
  gait stream walk.bvh --to 192.168.0.7:39540 --form gait --rate 60)");
}

}  // namespace

Command stream_command(CLI::App& program) {
  return make_command(program, "stream", "Send a clip over OSC as live motion", add_options,
                      stream);
}

}  // namespace gait::tool
