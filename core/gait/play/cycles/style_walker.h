// Style walker: walks by itself in the model's styles, and no two cycles are alike unless its
// variation is 0 (T10 §7).
//
// Each cycle has scores of its own in the space of styles and a duration of its own (eq. 2 and 4,
// cycle_draws.h); in the last tenth of a cycle the scores blend into those of the next. Beyond the
// paper scores are drawn with the correlations that they had in training: drawn independently, as
// in eq. 2, they make cycles that no walker makes. Styles mix by weights: means, largest changes
// and correlations are interpolated, deviations as those of independent draws. Knees and elbows
// never bend further than those in training (hinge_limits.h).
//
// Controls may be set between any two frames. What is set before the first frame holds from it on;
// after that nothing jumps: styles, variation, exaggeration and pins arrive within about a step. A
// control that cannot be set (not finite, no such style) changes nothing and returns false; numbers
// out of a control's range are clamped to it.
//
// Nothing allocates, throws or locks after construction. Seconds, radians; phase in cycles, 0 at
// the right contact, 0.5 at the left.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gait/model/model.h"
#include "gait/motion/steps.h"
#include "gait/play/change/glide.h"
#include "gait/play/change/style_mix.h"
#include "gait/play/cycles/cycle_draws.h"
#include "gait/play/cycles/cycle_pose.h"
#include "gait/play/cycles/style_tables.h"
#include "gait/play/play_model.h"

namespace gait {

class StyleWalker {
 public:
  // Starts neutral, at phase 0. The same seed gives the same walk. Throws Error when the model has
  // no style space or no body, saying how to train one that has.
  StyleWalker(const PlayModel& played, std::uint64_t seed);

  // One weight per style of the model, not negative, normalised. See StyleMix::set.
  bool set_weights(std::span<const float> weights) noexcept;
  bool set_style(int style) noexcept;
  // Whether a change of style goes through neutral (the style of that name or named normal, else
  // all styles alike) instead of directly.
  void set_through_neutral(bool through) noexcept { mix_.set_through_neutral(through); }
  // 0: the mean cycle for ever; 1 as in training; up to 2.
  bool set_variation(float variation) noexcept;
  // Along the line from the mean of all styles to this one: 0 the mean, 1 the style, up to 3 a
  // caricature, down to -1 its opposite.
  bool set_exaggeration(float exaggeration) noexcept;
  // Holds score `component` at `value` deviations of that component over all cycles, -6 to 6.
  bool pin(int component, float value) noexcept;
  bool free(int component) noexcept;
  bool set_cadence(
      float steps_per_second) noexcept;  // instead of the style's; 0: the style's, to 8

  // Starts anew at phase 0 with the first cycle of another walk; controls stay.
  void restart(std::uint64_t seed) noexcept;

  // Shows this cycle at another phase, 0 to 1 (1 left out): forth and back by hand. False, with
  // nothing changed, for any other number.
  bool scrub(double phase) noexcept;

  // Moves on. At most half a cycle at a time: longer is cut short. False, without moving, when
  // `seconds` is negative or not finite.
  bool advance(double seconds) noexcept;

  // Local rotations, one per joint of the model's body, the hips' with heading out: what
  // RootMotion takes.
  std::span<const Eigen::Quaternionf> pose() const noexcept { return pose_; }
  double phase() const noexcept { return phase_; }
  float cadence() const noexcept;                         // steps per second, now
  std::int64_t cycle() const noexcept { return cycle_; }  // 0 the first
  // The foot that met the ground during the last advance, and how many seconds before its end.
  std::optional<Foot> contact() const noexcept { return contact_; }
  double since_contact() const noexcept { return since_contact_; }

  int components() const noexcept { return static_cast<int>(scores_.size()); }
  const Eigen::VectorXf& scores() const noexcept { return scores_; }  // of this frame
  float duration() const noexcept;  // of this cycle, as drawn: seconds, before the cadence controls
  const Eigen::VectorXf& weights() const noexcept { return mix_.weights(); }

 private:
  bool set(Glide& glide, float value, float least, float most) noexcept;
  void settle() noexcept;  // controls set before the first frame hold at once
  void mix_styles() noexcept;
  DrawBounds bounds(int i) const noexcept;
  void draw_first_cycle() noexcept;
  void draw_next(int count) noexcept;  // up to this many numbers of the next cycle
  double frequency() const noexcept;   // cycles per second
  void show() noexcept;

  std::shared_ptr<const StyleTables> tables_;
  CyclePose cycle_pose_;
  StyleMix mix_;
  CycleDraws draws_;  // one per component, then the duration's

  // Of the tables, mixed by the weights.
  Eigen::VectorXf mean_, deviation_, limit_, range_;

  Glide variation_{1}, exaggeration_{1};
  std::vector<Glide> pinned_, pin_values_;  // how much, and at which score
  float cadence_ = 0;

  int drawn_ = 0;        // numbers of the next cycle that are drawn already
  Eigen::VectorXf row_;  // of the mixed factor
  bool moved_ = false;
  double phase_ = 0;
  std::int64_t cycle_ = 0;
  std::optional<Foot> contact_;
  double since_contact_ = 0;
  Eigen::VectorXf scores_;
  std::vector<Eigen::Quaternionf> pose_;
};

}  // namespace gait
