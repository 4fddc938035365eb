#include "gait/play/synthesise/label_durations.h"

#include <algorithm>
#include <cmath>

namespace gait {

LabelDurations::LabelDurations(const Eigen::MatrixXf& means)
    : means_(means),
      settings_(static_cast<std::size_t>(means.rows())),
      styled_(means.col(0)),
      seconds_(styled_),
      glides_(settings_.size(), Glide(1)) {}

bool LabelDurations::set_scale(float scale, int label) noexcept {
  if (!std::isfinite(scale) || !in_range(label)) return false;
  for (int i = 0; i < seconds_.size(); ++i)
    if (label == all || label == i) settings_[i].scale = std::clamp(scale, 0.1f, 10.0f);
  return true;
}

bool LabelDurations::set_shift(float seconds, int label) noexcept {
  if (!std::isfinite(seconds) || !in_range(label)) return false;
  for (int i = 0; i < seconds_.size(); ++i)
    if (label == all || label == i) settings_[i].shift = std::clamp(seconds, -10.0f, 10.0f);
  return true;
}

bool LabelDurations::fix(float seconds, int label) noexcept {
  if (!std::isfinite(seconds) || !in_range(label)) return false;
  for (int i = 0; i < seconds_.size(); ++i)
    if (label == all || label == i)
      settings_[i].fixed = seconds > 0 ? std::clamp(seconds, shortest, longest) : 0.0f;
  return true;
}

bool LabelDurations::set_cadence(float cadence) noexcept {
  if (!std::isfinite(cadence)) return false;
  cadence_ = std::clamp(cadence, 0.0f, 10.0f);
  return true;
}

float LabelDurations::wanted(Eigen::Index label) const noexcept {
  const Setting& setting = settings_[static_cast<std::size_t>(label)];
  if (setting.fixed > 0) return setting.fixed;
  float seconds = styled_[label] * tempo_;
  if (cadence_ > 0) seconds = styled_[label] / (styled_.mean() * cadence_);
  return std::clamp(seconds * setting.scale + setting.shift, shortest, longest);
}

void LabelDurations::advance(float labels, const Eigen::VectorXf& weights) noexcept {
  styled_.noalias() = means_ * weights;
  const float share = glide_share(labels, 1);
  for (Eigen::Index i = 0; i < seconds_.size(); ++i) {
    Glide& glide = glides_[static_cast<std::size_t>(i)];
    glide.set(wanted(i) / styled_[i]);
    glide.advance(share);
    seconds_[i] = std::clamp(glide.value() * styled_[i], shortest, longest);
  }
}

void LabelDurations::arrive(const Eigen::VectorXf& weights) noexcept {
  styled_.noalias() = means_ * weights;
  for (Eigen::Index i = 0; i < seconds_.size(); ++i) {
    Glide& glide = glides_[static_cast<std::size_t>(i)];
    glide.set(wanted(i) / styled_[i]);
    glide.arrive();
    seconds_[i] = std::clamp(glide.value() * styled_[i], shortest, longest);
  }
}

void LabelDurations::take_over(const LabelDurations& other) noexcept {
  settings_ = other.settings_;
  cadence_ = other.cadence_, tempo_ = other.tempo_;
  glides_ = other.glides_;
  seconds_ = other.seconds_;
}

}  // namespace gait
