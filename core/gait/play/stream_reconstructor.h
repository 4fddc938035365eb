// Stream reconstructor (T14 §4): what a sender measures of a motion in, the whole motion out.
//
// It is the chain that [gait.viterbi~], [gait.map], [gait.synth] and [gait.skeleton] form in a
// patch: recogniser, observation map, synthesiser and, for the model of a body, the body on stage.
// Tool, judge and benchmarks play through it, so that what they measure is what a patch plays.
//
// Frames may come at any rate, and any stream may go missing and come back; frames leave at the
// model's rate, late by the decoder's lag and the trajectory's delay. Each frame that leaves
// carries the time, heading, decision and measured values of the frame that came. Nothing
// allocates, throws or locks after construction.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gait/play/body/body_stage.h"
#include "gait/play/map/observation_map.h"
#include "gait/play/play_model.h"
#include "gait/play/recognise/live_recogniser.h"
#include "gait/play/synthesise/synthesiser.h"

namespace gait {

// The model supplies each optional setting that is left empty.
struct PlaySettings : RecogniserSettings {
  std::optional<double> strength;   // of the mapping, -10 to 10
  std::optional<int> past, future;  // frames of the trajectory's queue: P (or whole_past), F
  int current = 1;                  // C: it is solved every C frames
  // Walks on when the input stops, and goes back to it without a jump when it returns. If false, a
  // frame after a gap begins anew.
  bool walks_alone = false;
  bool on_stage = true;  // whether to move a body over the ground, where the model has one
};

struct ReconstructedFrame {
  double time = 0;  // of the frame that came, by the sender's clock
  Decision decision;
  std::span<const float> styles;   // posteriors, one per style
  std::span<const float> outputs;  // model.output.values values
  // On stage, one local rotation per joint of the body; the hips' is in the world, without the
  // heading. Heading (radians) is 0 unless measured; hips (metres) come from the feet. Without a
  // stage `pose` is empty and `hips` 0.
  std::span<const Eigen::Quaternionf> pose;
  float heading = 0;
  Eigen::Vector3f hips = Eigen::Vector3f::Zero();
};

class StreamReconstructor {
 public:
  // Throws Error as the four parts do, when the model cannot be played so.
  explicit StreamReconstructor(const PlayModel& played, const PlaySettings& settings = {});

  // Frames of a sender at its own times: push them here, then call next() until it says false.
  InputStream& stream() noexcept { return recogniser_.stream(); }
  // Pushes local rotations of all input joints of a body, the hips' in the world. Rejected, with
  // nothing changed, as InputStream does.
  FrameClock::Arrival push(double time, std::span<const Eigen::Quaternionf> rotations) noexcept;
  // Makes the next frame that is due. False when none is.
  bool next() noexcept;
  // Or takes frames at the model's rate, model.input.values values each (see Recogniser for those
  // that are no measurements); their times are counted from 0. True when a frame was made.
  bool advance(std::span<const float> values) noexcept;

  // At the end of a stream: makes the next of the frames that are held back. False when none is.
  bool flush() noexcept;
  // With walks_alone: lose() says that the stream has stopped; each go_on() then makes a frame
  // without input.
  void lose() noexcept;
  bool go_on() noexcept;

  // The frame made last, until the next call.
  const ReconstructedFrame& frame() const noexcept { return frame_; }

  // Of an input. A missing one is held as it was, and not looked at.
  void set_missing(int stream, bool missing) noexcept { recogniser_.set_missing(stream, missing); }
  // Whether the decoder sees exactly the inputs that are there (see Recogniser).
  bool settled() const noexcept { return recogniser_.recogniser().settled(); }
  int delay() const noexcept;  // frames by which output is late

  // The parts, to set and to ask them. There is a stage for the model of a body, if it was asked
  // for.
  const LiveRecogniser& recogniser() const noexcept { return recogniser_; }
  ObservationMap& map() noexcept { return map_; }
  Synthesiser& synthesiser() noexcept { return synthesiser_; }
  const Synthesiser& synthesiser() const noexcept { return synthesiser_; }
  BodyStage* stage() noexcept { return stage_ ? &*stage_ : nullptr; }
  const Model& model() const noexcept { return synthesiser_.model(); }

  // Begins anew, with the body at `place`; settings stay.
  void reset(const Eigen::Vector3f& place = Eigen::Vector3f::Zero()) noexcept;

 private:
  struct Taken {  // what the frame that leaves needs of the frame that came
    double time = 0;
    std::optional<float> heading;
    std::vector<float> inputs;
    Decision decision;
    std::vector<float> styles;
  };

  Taken& taken(int frame) noexcept { return ring_[frame % ring_.size()]; }
  bool take(double time, std::optional<float> heading, std::span<const float> values) noexcept;
  bool map_decided() noexcept;
  void tell_place() noexcept;
  void make() noexcept;
  void begin_anew() noexcept;

  LiveRecogniser recogniser_;
  ObservationMap map_;
  Synthesiser synthesiser_;
  std::optional<BodyStage> stage_;
  bool walks_alone_;
  std::vector<Taken> ring_;
  int taken_ = 0, decided_ = 0;  // frames so far
  int places_ = 0;               // that the synthesiser was given since the stream began
  bool whole_ = false;           // a whole pose is shown, of which nothing was measured
  ReconstructedFrame frame_;
};

}  // namespace gait
