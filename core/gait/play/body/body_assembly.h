// One body from its parts: synthesised output joints with the measured input joints that they were
// made from, or a whole pose; the one that came last is shown.
//
// Measured frames are delayed until the outputs made from them arrive. When whole poses take over
// from parts, as when the input is lost and a walker goes on alone, and when parts take over again,
// nothing jumps: the change is inertialised (StreamHandOver) over half a second.
//
// Values are rotation vectors relative to the model's references (radians), three per joint.
// Nothing allocates after construction.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "gait/model/stream_layout.h"
#include "gait/play/body/delayed_frames.h"
#include "gait/play/change/stream_hand_over.h"

namespace gait {

class BodyAssembly {
 public:
  // The model must have a body.
  explicit BodyAssembly(std::shared_ptr<const Model> model);

  // Each false, with nothing changed, when the size is another or a value is not finite.
  bool store_inputs(std::span<const float> values) noexcept;  // measured: model.input.values
  bool store_pose(std::span<const float> values) noexcept;    // the same out of a whole pose
  bool take_outputs(std::span<const float> values) noexcept;  // model.output.values
  bool take_pose(std::span<const float> values) noexcept;     // 3 per joint of the body

  // Frames by which outputs are late, up to DelayedFrames::longest_delay.
  void set_delay(int frames) noexcept { delay_ = frames; }
  int delay() const noexcept { return delay_; }

  // 3 per joint of the body, of the last frame taken.
  const Eigen::VectorXf& values() const noexcept { return shown_; }
  // Whether that was a whole pose, or is still on its way from or to one.
  bool whole() const noexcept { return source_ == Source::whole || !hand_over_.over(); }
  void reset() noexcept;

 private:
  enum class Source { none, parts, whole };

  void show(Source source) noexcept;

  std::shared_ptr<const Model> model_;
  StreamLayout inputs_, outputs_;
  DelayedFrames measured_;
  StreamHandOver hand_over_;
  int delay_ = 0;
  Source source_ = Source::none;
  int shown_frames_ = 0;  // at most 2
  Eigen::VectorXf stored_, taken_, shown_, before_;
};

}  // namespace gait
