// Step walker (T14 §4.3, MAGE's reactive control): walks by itself, label after label, whatever the
// labels are; steps for a walk.
//
// Labels queue up and last as the model or the player says; the states of a label share its
// duration in proportion of their mean durations. Each frame the Gaussian of the moment, between
// the states' and mixed over the styles by weights, goes into the same trajectory generator that
// reconstructs, here over inputs and outputs together. The walker knows what comes next, so the
// queue looks `future` frames ahead: output is smooth and not late; only changes of label, style
// and duration show that much later.
//
// Controls may be set between any two frames. What is set before the first frame holds from it on;
// after that nothing jumps: changes arrive within about a step. A control that cannot be set (not
// finite, no such label, style or stream) changes nothing and returns false; numbers out of a
// control's range are clamped to it. The same controls give the same walk.
//
// Nothing allocates, throws or locks after construction. Seconds, radians; no root: see RootMotion.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gait/model/model.h"
#include "gait/play/change/style_mix.h"
#include "gait/play/play_model.h"
#include "gait/play/synthesise/label_durations.h"
#include "gait/play/synthesise/label_queue.h"
#include "gait/play/synthesise/step_gaussian.h"
#include "gait/play/synthesise/step_tables.h"
#include "gait/play/synthesise/stream_controls.h"
#include "gait/play/synthesise/trajectory.h"

namespace gait {

struct StepWalkerSettings {
  std::optional<int> past;    // frames of state queue (P, or whole_past), else the model's
  std::optional<int> future;  // frames looked ahead (F), else 0.2 s
};

// Where a walk is.
struct StepPlace {
  int label = 0;
  float progress = 0;  // through the label, 0..1
  float cadence = 0;   // labels per second; 0: as the model has it
};

class StepWalker {
 public:
  // Starts in the neutral style, with the first label or the first one queued. Throws Error when
  // the model was learnt without trajectory statistics.
  explicit StepWalker(const PlayModel& played, const StepWalkerSettings& settings = {});

  // The label comes after those queued already, led up to by those that must lie between. See
  // LabelQueue::push.
  bool queue(int label) noexcept { return queue_.push(label, ahead_.label); }
  int queued() const noexcept { return queue_.size(); }
  // Whether labels follow by themselves (on at first); else the walk stands at a label's end.
  void set_auto(bool on) noexcept { queue_.set_auto(on); }

  // One weight per style of the model, not negative, normalised. See StyleMix::set.
  bool set_weights(std::span<const float> weights) noexcept;
  bool set_style(int style) noexcept;
  void set_through_neutral(bool through) noexcept { mix_.set_through_neutral(through); }

  // How long labels last; how single streams (inputs, then outputs) are bent.
  LabelDurations& durations() noexcept { return durations_; }
  StreamControls& streams() noexcept { return controls_; }
  // The stream of a joint of the body, -1 when it has none.
  int stream_of(int joint) const noexcept { return layout_.stream_of(joint); }

  // Makes the next frame, 1 / model.frame_rate later.
  void advance() noexcept;
  // Multiplies the cadence from here on, 0.1 to 4, beside the controls: to fall in step with
  // another walk.
  void set_pace(float pace) noexcept;
  // How many cycles it will be behind a walk that is now at this phase and cadence (labels per
  // second), when what is decided now is shown: -0.6 to 0.4, as waiting is easier than hurrying.
  float behind(float phase, float cadence) const noexcept;
  // Goes on from here: the frame that was last shown is at this place. Styles and cadence are at
  // once as given, styles without a walk left out. Stream controls and the queue stay.
  void enter(const StepPlace& place, std::span<const float> weights) noexcept;
  // The place `labels` on from a phase of the cycle that the label belongs to.
  StepPlace place_at(int label, float phase, float labels = 0) const noexcept;
  // Anew from the beginning; controls stay, the queue is cleared.
  void reset() noexcept;
  // Goes on where another walker is, whose model may be another, for instance one that was made
  // while it walked: queue, phase and controls live on. False, with nothing changed, unless labels,
  // states, styles and values are as many.
  bool take_over(const StepWalker& other) noexcept;

  // Of the last frame. Values in the streams' order; pose: local rotations, one per joint of the
  // body, the hips' with heading out; empty without a body.
  std::span<const float> inputs() const noexcept;
  std::span<const float> outputs() const noexcept;
  std::span<const Eigen::Quaternionf> pose() const noexcept { return pose_; }
  int label() const noexcept { return shown().label; }  // -1 before the first frame
  int state() const noexcept;                           // within the label
  float progress() const noexcept { return shown().progress; }
  float phase() const noexcept { return phase_of(shown()); }  // through the cycle of labels, 0..1
  float cadence() const noexcept;  // labels per second; 0 while it stands
  // The label that began with this frame: of a walk, which foot touched.
  std::optional<int> entered() const noexcept { return entered_; }
  const Eigen::VectorXf& weights() const noexcept { return mix_.weights(); }

 private:
  struct Place {
    int label = LabelQueue::none, before = LabelQueue::none;
    float progress = 0;
    bool standing = false;
  };

  void begin() noexcept;
  void fill() noexcept;
  Place back(Place place, float seconds) const noexcept;
  void move() noexcept;
  void push(const Place& place) noexcept;
  void show() noexcept;
  float phase_of(const Place& place) const noexcept;
  const Place& shown() const noexcept { return places_[static_cast<std::size_t>(newest_)]; }

  std::shared_ptr<const Model> model_;
  std::shared_ptr<const StepTables> tables_;
  float period_;
  LabelQueue queue_;
  LabelDurations durations_;
  StyleMix mix_;
  StreamLayout layout_;  // of inputs and outputs
  StreamControls controls_;
  Trajectory trajectory_;
  int past_;

  bool started_ = false;
  float pace_ = 1;
  Place ahead_;                // the newest in the queue of states
  std::vector<Place> places_;  // ring: from the one shown to the one ahead
  int newest_ = 0;
  std::optional<int> entered_;

  StepGaussian gaussian_;
  Eigen::VectorXf given_;  // scratch: per style
  Eigen::VectorXf values_, means_;
  std::vector<Eigen::Quaternionf> references_, pose_;
  std::vector<float> phase_begin_, phase_span_;  // per label
};

}  // namespace gait
