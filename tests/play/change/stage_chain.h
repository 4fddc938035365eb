// What a patch plays, without the patch: a stream that is lost and comes back, and all that was
// shown.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gait/model/body_pose.h"
#include "gait/motion/clip.h"
#include "gait/play/stream_reconstructor.h"
#include "play/change/joint_motion.h"

namespace gait::testing {

// Everything shown, frame after frame.
struct Shown {
  std::vector<Pose> poses;  // hips with heading out
  std::vector<Eigen::Vector3d> hips;
  std::vector<double> phases;
  std::vector<bool> alone;

  std::size_t frames() const { return poses.size(); }
  // Right and left contacts, by the phase.
  std::vector<Contact> contacts() const {
    std::vector<Contact> found;
    for (std::size_t i = 1; i < phases.size(); ++i) {
      const double moved = phases[i] - phases[i - 1];
      if (moved < -0.5) found.push_back({static_cast<int>(i), Foot::right});
      if (moved > 0 && phases[i - 1] < 0.5 && phases[i] >= 0.5)
        found.push_back({static_cast<int>(i), Foot::left});
    }
    return found;
  }
};

class StageChain {
 public:
  explicit StageChain(const std::shared_ptr<const Model>& model, OnLost on_lost = OnLost::walk)
      : reconstructor_(model, walking_alone()) {
    reconstructor_.synthesiser().set_on_lost(on_lost);
  }

  // A frame of the sender's, as values of the model's inputs.
  void feed(double time, std::span<const float> inputs) {
    reconstructor_.stream().push(time, inputs);
    while (reconstructor_.next()) show();
  }
  // The sender is silent, and it was noticed.
  void lose() { reconstructor_.lose(); }
  void go_on(int frames) {
    for (int i = 0; i < frames; ++i)
      if (reconstructor_.go_on()) show();
  }
  void reset() {
    reconstructor_.reset();
    shown_ = {};
  }

  const Model& model() const { return reconstructor_.model(); }
  const Synthesiser& synthesiser() const { return reconstructor_.synthesiser(); }
  const BodyStage& stage() { return *reconstructor_.stage(); }
  const Shown& shown() const { return shown_; }

  // What was shown, in the world.
  Clip clip() const {
    Clip clip =
        body_clip(*model().body, "shown", model().frame_rate, static_cast<int>(shown_.frames()));
    for (std::size_t frame = 0; frame < shown_.frames(); ++frame)
      place_body(clip, static_cast<int>(frame), body_roles(*model().body), shown_.poses[frame], 0,
                 shown_.hips[frame]);
    return clip;
  }

 private:
  static PlaySettings walking_alone() {
    PlaySettings settings;
    settings.walks_alone = true;
    return settings;
  }
  void show() {
    const ReconstructedFrame& frame = reconstructor_.frame();
    shown_.poses.emplace_back();
    for (const Eigen::Quaternionf& rotation : frame.pose)
      shown_.poses.back().push_back(rotation.cast<double>());
    shown_.hips.push_back(frame.hips.cast<double>());
    shown_.phases.push_back(
        static_cast<double>(synthesiser().walks() ? synthesiser().walker().phase()
                                                  : reconstructor_.recogniser().decision().phase));
    shown_.alone.push_back(synthesiser().alone());
  }

  StreamReconstructor reconstructor_;
  Shown shown_;
};

}  // namespace gait::testing
