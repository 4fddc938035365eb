// How long labels last, in seconds: as the model says for the mix of styles, scaled and shifted, at
// a cadence the player gives, or fixed.
//
// Changes arrive within about one label (glide.h), so that no step is cut short.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "gait/play/change/glide.h"

namespace gait {

class LabelDurations {
 public:
  static constexpr float shortest = 0.1f, longest = 60;  // seconds, whatever is set
  static constexpr int all = -1;

  // `means`: seconds, labels by styles (one column without styles).
  explicit LabelDurations(const Eigen::MatrixXf& means);

  // Each for one label or all. False, with nothing changed, when a number is not finite or there is
  // no such label. Scale 0.1 to 10; shift -10 to 10 s; fix 0 (as the model) or 0.1 to 60 s.
  bool set_scale(float scale, int label = all) noexcept;
  bool set_shift(float seconds, int label = all) noexcept;
  bool fix(float seconds, int label = all) noexcept;
  // Labels per second, the same for all in mean; fixed ones stay. 0: the model's; at most 10.
  bool set_cadence(float cadence) noexcept;

  // Durations change by this ratio from one moment to the next, e.g. to those of a performer.
  void set_tempo(float ratio) noexcept { tempo_ = ratio; }

  // Moves on by `labels`, a share of a label, and takes the weights of styles, sum 1.
  void advance(float labels, const Eigen::VectorXf& weights) noexcept;
  void arrive(const Eigen::VectorXf& weights) noexcept;  // at once

  float of(int label) const noexcept { return seconds_[label]; }
  float model_mean() const noexcept { return styled_.mean(); }  // over labels, of the style mix

  void take_over(const LabelDurations& other) noexcept;  // its settings; as many labels

 private:
  float wanted(Eigen::Index label) const noexcept;
  bool in_range(int label) const noexcept { return label >= all && label < seconds_.size(); }

  struct Setting {
    float scale = 1, shift = 0, fixed = 0;
  };
  Eigen::MatrixXf means_;
  std::vector<Setting> settings_;
  float cadence_ = 0, tempo_ = 1;
  Eigen::VectorXf styled_, seconds_;
  std::vector<Glide> glides_;  // what was set, over what the style mix lasts: a ratio
};

}  // namespace gait
