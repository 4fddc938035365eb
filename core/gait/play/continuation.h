// Continuation: a reconstruction that goes on by itself when its input stops, from the very pose it
// was in, and comes back when poses come again.
//
// Lost, it flushes what was held back and walks on alone (StepWalker) at the phase, cadence and
// styles of the last decision; or it holds its pose; or it stops. When poses come again it stays
// alone until the observations' history is whole and the walker has fallen in step with them (for
// two seconds at most), then goes over. At either hand-over pose and speed are continuous
// (hand_over.h); one root for all keeps the feet on the ground. While poses come without a break,
// frames are those of the Reconstructor.
//
// Nothing allocates, throws or locks after construction.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gait/play/hand_over.h"
#include "gait/play/on_lost.h"
#include "gait/play/reconstructor.h"
#include "gait/play/step_walker.h"

namespace gait {

class Continuation {
 public:
  // Throws Error as Reconstructor and StepWalker do.
  explicit Continuation(std::shared_ptr<const Model> model, const PlayerSettings& settings = {},
                        const StepWalkerSettings& walking = {});

  // Takes a pose, as Reconstructor::push; then call next() until it says false.
  FrameClock::Arrival push(double time, std::span<const Eigen::Quaternionf> inputs) noexcept;
  // Makes the next frame that is due; `frame` speaks of it until the next call.
  bool next() noexcept;
  // No pose came for a frame's time: makes the next frame without one. False when it stopped, or
  // when there is nothing to hold.
  bool go_on() noexcept;
  // Decision and styles of a frame made alone are the walker's (likelihood and distance 0).
  const ReconstructedFrame& frame() const noexcept { return frame_; }
  bool alone() const noexcept { return alone_; }  // that frame was made without input

  void set_on_lost(OnLost what) noexcept { on_lost_ = what; }
  void set_missing(int input, bool missing) noexcept { reconstructor_.set_missing(input, missing); }

  // What walks alone, to control it; its queue, durations and streams live on from one loss of
  // input to the next, styles and place are taken from the reconstruction.
  StepWalker& walker() noexcept { return walker_; }
  Player& player() noexcept { return reconstructor_.player(); }
  const Model& model() const noexcept { return reconstructor_.model(); }
  int delay() const noexcept { return reconstructor_.delay(); }  // frames, while poses come
  void reset(const Eigen::Vector3f& place = Eigen::Vector3f::Zero()) noexcept;

  // For a change of model between two frames: goes on where `other` is. Queue, phase and root live
  // on; it is alone until its own reconstruction knows enough. False, with nothing changed, unless
  // the models are of equal sizes.
  bool take_over(const Continuation& other) noexcept;

 private:
  struct Motion {  // of one frame
    std::vector<Eigen::Quaternionf> pose;
    float heading = 0;
    Eigen::VectorXf outputs;
  };
  struct Moving {  // the last two frames of a motion
    Motion now, before;
    void take(std::span<const Eigen::Quaternionf> pose, float heading,
              std::span<const float> outputs) noexcept;
  };

  void begin_alone() noexcept;
  void walk_from_shown() noexcept;
  void hand_over_to(const Moving& motion) noexcept;
  void difference(const Motion& shown, const Motion& motion,
                  Eigen::VectorXf& offset) const noexcept;
  bool fall_in_step() noexcept;
  void make_alone(double time) noexcept;
  void make_fed() noexcept;
  void show(const Motion& motion) noexcept;
  void show_outputs() noexcept;
  std::size_t outputs() const noexcept {
    return static_cast<std::size_t>(shown_.now.outputs.size());
  }

  Reconstructor reconstructor_;
  StepWalker walker_;
  RootMotion root_;
  HandOver hand_over_;
  std::vector<Eigen::Quaternionf> references_;
  // Frames until a reconstruction that began anew is believed, and until it is followed whatever
  // its phase.
  int settling_, patience_;
  double period_;

  OnLost on_lost_ = OnLost::walk, alone_as_ = OnLost::walk;
  bool alone_ = false;
  int returned_ = 0;  // frames reconstructed again while still alone
  int shown_frames_ = 0;
  double gentle_ = 0;  // seconds that the root is still to be gentle
  Moving shown_, source_, fed_;
  Eigen::VectorXf offset_, offset_before_;  // per joint three, heading, then outputs
  std::vector<float> styles_;
  ReconstructedFrame frame_;
};

}  // namespace gait
