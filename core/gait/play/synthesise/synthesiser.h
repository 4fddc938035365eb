// Synthesiser (T14 §4.3, MAGE): Gaussians in, smooth output frames out; without them it walks
// alone.
//
// Fed, it runs the trajectory generator over the frames' Gaussians (FedTrajectory). Alone it is a
// StepWalker, if it may walk alone. When the input stops, it hands out the frames that were held
// back; then it walks on from its last outputs, comes to rest, or stops. When the input returns, it
// stays alone until the observations' history is whole again and the walker has fallen in step
// (two seconds at most; at once without set_place()). Hand-overs are continuous in value and speed.
//
// A whole body is the input joints with the outputs. Only the walker knows input joints: while it
// is fed they stay where the walker had them last (at first, in the mean of training).
//
// Nothing allocates, throws or locks after construction, but for set_past and set_future. Radians,
// seconds; values and poses as in the model's streams.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gait/model/model.h"
#include "gait/play/change/stream_hand_over.h"
#include "gait/play/synthesise/fed_trajectory.h"
#include "gait/play/synthesise/on_lost.h"
#include "gait/play/synthesise/step_walker.h"
#include "gait/play/synthesise/stream_controls.h"

namespace gait {

struct SynthesiserSettings {
  // Frames of the fed trajectory's queue: P (or whole_past), F; else the model's.
  std::optional<int> past, future;
  int current = 1;  // C
  // Whether it can walk alone, which takes a model with trajectory statistics. If not, it comes to
  // rest when the input stops.
  bool walks_alone = true;
};

class Synthesiser {
 public:
  static constexpr int longest_past = 600, longest_future = 120;  // frames

  // Throws Error as StepWalker does, if it is to walk alone.
  explicit Synthesiser(const PlayModel& played, const SynthesiserSettings& settings = {});

  // Takes the next frame's Gaussian over all output values: statics, first, then second differences
  // per frame, 3 * model.output.values of either. Values that the model leaves out keep their mean.
  // True when a frame was made; false while the future's first frames come in. `after_gap`: no
  // frame came for longer than a period, and go_on() was not called meanwhile. If the new frame
  // does not follow the one shown, the trajectory begins anew, without a jump.
  bool push(std::span<const float> means, std::span<const float> variances,
            bool after_gap = false) noexcept;
  // Whether push would take them: of that size, finite, variances of modelled values positive.
  bool fits(std::span<const float> means, std::span<const float> variances) const noexcept;
  // Makes the next frame, 1 / model.frame_rate on, without one. False when it stopped, or when
  // there is nothing to hold.
  bool go_on() noexcept;
  // Makes the next of the frames that are held back, at the end of a stream. False when none is.
  bool flush() noexcept;

  // Where the walk that feeds it is: phase of the cycle, labels per second, a weight per style. It
  // walks on alone from there, and falls in step with it. False, with nothing changed, when a
  // number is not finite or the weights are not as many as the styles.
  bool set_place(float phase, float cadence, std::span<const float> weights) noexcept;
  // Whether the body that feeds it walks. If it stood when the input stopped, it stands on.
  void set_walking(bool walking) noexcept;
  void set_on_lost(OnLost what) noexcept { on_lost_ = what; }

  // Frames of the fed trajectory's queue; its past may be whole_past. These allocate.
  void set_past(int frames);
  void set_future(int frames);
  int past() const noexcept { return trajectory_.past(); }
  int future() const noexcept { return trajectory_.future(); }
  int delay() const noexcept { return trajectory_.delay(); }  // frames by which output is late
  // How many frames were fed after the one that was made last.
  int held() const noexcept { return trajectory_.held(); }

  // Controls of single streams, inputs then outputs (StreamControls), for both ways of walking.
  bool set_scale(int stream, float scale) noexcept;
  bool set_shift(int stream, std::span<const float> by) noexcept;
  bool fix(int stream, std::span<const float> at) noexcept;
  bool free(int stream) noexcept;

  // Of the last frame made.
  bool alone() const noexcept { return alone_; }    // without input
  bool walks() const noexcept;                      // alone, by the walker: then ask it where
  std::span<const float> outputs() const noexcept;  // model.output.values
  // Per joint of the body three values relative to its reference; without a body the inputs'
  // values, then the outputs'.
  std::span<const float> pose() const noexcept { return pose_; }

  // What walks alone, to control it: its queue, durations and styles. Streams: see above. There is
  // none if it does not walk alone.
  StepWalker& walker() noexcept { return *walker_; }
  const StepWalker& walker() const noexcept { return *walker_; }
  const Model& model() const noexcept { return *model_; }

  // Anew, alone and unfed; settings stay.
  void reset() noexcept;
  // Goes on where another one is, whose model may be another; settings live on. False, with nothing
  // changed, unless the models are of equal sizes. Allocates when the queues differ in length, or
  // in which values move.
  bool take_over(const Synthesiser& other);

 private:
  struct Moving {  // the last two frames of a motion, inputs' values then outputs'
    Eigen::VectorXf now, before;
    void take(const Eigen::VectorXf& values) noexcept;
  };

  void take_fed() noexcept;
  void take_walked() noexcept;
  void begin_alone() noexcept;
  void walk_from_shown() noexcept;
  void hand_over_to(const Moving& motion, bool speed_known) noexcept;
  bool follows_shown(std::span<const float> means, std::span<const float> variances) const noexcept;
  bool in_step() noexcept;
  void make_alone() noexcept;
  void show(const Moving& motion) noexcept;
  void move_place() noexcept;
  OnLost wanted() const noexcept;

  std::shared_ptr<const Model> model_;
  std::optional<StepWalker> walker_;
  FedTrajectory trajectory_;
  StreamControls controls_;  // of fed frames
  StreamHandOver hand_over_;
  float period_, cadence_;      // of a frame, seconds; labels per second in the model's mean
  int inputs_;                  // values
  int settling_, patience_;     // frames
  std::vector<int> positions_;  // in the pose, per value of inputs and outputs; -1: in none

  bool jumps_ = false;  // the next fed frame does not follow the one shown
  OnLost on_lost_ = OnLost::walk, alone_as_ = OnLost::walk;
  bool alone_ = false, walking_ = true, stood_ = false;
  int returned_ = 0;      // frames fed again while still alone
  int shown_frames_ = 0;  // at most 2
  struct {
    bool known = false, fresh = false, just_said = false;
    float phase = 0, cadence = 0;
  } place_;
  std::vector<float> weights_;
  float labels_in_cycle_;

  Eigen::VectorXf means_, scratch_;  // of all values
  Moving shown_, walked_, fed_;
  std::vector<float> pose_;
};

}  // namespace gait
