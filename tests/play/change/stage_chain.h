// What a patch plays, without the patch: recogniser, map, synthesiser and the body on stage, joined
// as their boxes are, and all that was shown.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gait/model/body_pose.h"
#include "gait/motion/clip.h"
#include "gait/play/body/body_stage.h"
#include "gait/play/map/observation_map.h"
#include "gait/play/recognise/live_recogniser.h"
#include "gait/play/synthesise/synthesiser.h"
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
  explicit StageChain(std::shared_ptr<const Model> model, OnLost on_lost = OnLost::walk)
      : model_(std::move(model)),
        recogniser_(model_),
        map_(model_),
        synthesiser_(model_),
        stage_(model_) {
    stage_.set_delay(synthesiser_.future());
    synthesiser_.set_on_lost(on_lost);
  }

  // A frame of the sender's, as values of the model's inputs.
  void feed(double time, std::span<const float> inputs) {
    stage_.store_inputs(inputs);
    recogniser_.stream().push(time, inputs);
    while (recogniser_.next()) {
      const Recogniser& seen = recogniser_.recogniser();
      synthesiser_.set_walking(recogniser_.walking());
      if (told_++ < 2 * model_->frame_rate) tell_place();
      phase_ = seen.decision().phase;
      map_.map(seen.states(), seen.missing(),
               {seen.observation().data(), static_cast<std::size_t>(seen.known())});
      if (synthesiser_.push(map_.mean(), map_.variance())) show();
    }
  }
  // The sender is silent, and it was noticed.
  void lose() {
    tell_place();
    recogniser_.reset();
    told_ = 0;
  }
  void go_on(int frames) {
    for (int i = 0; i < frames; ++i)
      if (synthesiser_.go_on()) show();
  }
  void reset() {
    recogniser_.reset(), synthesiser_.reset(), stage_.reset();
    told_ = 0;
    whole_ = false;
    shown_ = {};
  }

  const Model& model() const { return *model_; }
  const Synthesiser& synthesiser() const { return synthesiser_; }
  const BodyStage& stage() const { return stage_; }
  const Shown& shown() const { return shown_; }

  // What was shown, in the world.
  Clip clip() const {
    Clip clip =
        body_clip(*model_->body, "shown", model_->frame_rate, static_cast<int>(shown_.frames()));
    for (std::size_t frame = 0; frame < shown_.frames(); ++frame)
      place_body(clip, static_cast<int>(frame), body_roles(*model_->body), shown_.poses[frame], 0,
                 shown_.hips[frame]);
    return clip;
  }

 private:
  void tell_place() {
    const Recogniser& seen = recogniser_.recogniser();
    synthesiser_.set_place(seen.decision().phase, seen.decision().cadence, seen.styles());
  }
  void show() {
    if (synthesiser_.walks())
      whole_ = true;
    else if (!synthesiser_.alone())
      whole_ = false;
    if (whole_)
      stage_.show_pose(synthesiser_.pose());
    else
      stage_.show_outputs(synthesiser_.outputs());
    shown_.poses.emplace_back();
    for (std::size_t joint = 0; joint < model_->body->references.size(); ++joint) {
      const auto value = stage_.pose().subspan(3 * joint).first<3>();
      shown_.poses.back().push_back(
          model_->body->references[joint] *
          exponential_map<double>(Eigen::Vector3d(value[0], value[1], value[2])));
    }
    shown_.hips.push_back(stage_.root().hips.cast<double>());
    shown_.phases.push_back(
        static_cast<double>(synthesiser_.walks() ? synthesiser_.walker().phase() : phase_));
    shown_.alone.push_back(synthesiser_.alone());
  }

  std::shared_ptr<const Model> model_;
  LiveRecogniser recogniser_;
  ObservationMap map_;
  Synthesiser synthesiser_;
  BodyStage stage_;
  int told_ = 0;  // places, since the stream began
  float phase_ = 0;
  bool whole_ = false;  // who comes to rest does so with the joints that were shown
  Shown shown_;
};

}  // namespace gait::testing
