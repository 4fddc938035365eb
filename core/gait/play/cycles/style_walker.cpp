#include "gait/play/cycles/style_walker.h"

#include <algorithm>
#include <cmath>

#include "gait/motion/smoothing.h"

namespace gait {

namespace {

constexpr double join = 0.1;      // of the phase: over which one cycle becomes the next
constexpr double drawing = 0.75;  // of the phase: over which the next cycle is drawn
constexpr float step = 0.5f;      // cycles: over which a control arrives

}  // namespace

StyleWalker::StyleWalker(const PlayModel& played, std::uint64_t seed)
    : tables_(played.styles()),
      cycle_pose_(tables_->cycles),
      mix_(tables_->can_walk, tables_->neutral),
      draws_(cycle_pose_.components() + 1, seed) {
  const int components = cycle_pose_.components();
  mean_ = deviation_ = limit_ = row_ = tables_->overall;
  range_ = Eigen::VectorXf::Zero(2);
  pinned_.assign(components, Glide(0));
  pin_values_.assign(components, Glide(0));
  scores_ = Eigen::VectorXf::Zero(components);
  pose_.resize(played.model->body->skeleton.joints.size());
  restart(seed);
}

void StyleWalker::restart(std::uint64_t seed) noexcept {
  draws_.seed(seed);
  moved_ = false;
  phase_ = 0, cycle_ = 0;
  contact_.reset();
  since_contact_ = 0;
  settle();
}

void StyleWalker::settle() noexcept {
  if (moved_) return;
  mix_.arrive();
  variation_.arrive(), exaggeration_.arrive();
  for (Glide& glide : pinned_) glide.arrive();
  for (Glide& glide : pin_values_) glide.arrive();
  mix_styles();
  draw_first_cycle();
  show();
}

bool StyleWalker::set_weights(std::span<const float> weights) noexcept {
  if (!mix_.set(weights)) return false;
  settle();
  return true;
}

bool StyleWalker::set_style(int style) noexcept {
  if (!mix_.set_only(style)) return false;
  settle();
  return true;
}

bool StyleWalker::set(Glide& glide, float value, float least, float most) noexcept {
  if (!std::isfinite(value)) return false;
  glide.set(std::clamp(value, least, most));
  settle();
  return true;
}

bool StyleWalker::set_variation(float variation) noexcept {
  return set(variation_, variation, 0, 2);
}

bool StyleWalker::set_exaggeration(float exaggeration) noexcept {
  return set(exaggeration_, exaggeration, -1, 3);
}

bool StyleWalker::pin(int component, float value) noexcept {
  if (component < 0 || component >= components() || !std::isfinite(value)) return false;
  Glide& place = pin_values_[static_cast<std::size_t>(component)];
  Glide& held = pinned_[static_cast<std::size_t>(component)];
  set(place, value, -6, 6);
  // Not held yet: nothing can jump, and it shall not come from where it was held last.
  if (held.value() == 0) place.arrive();
  return set(held, 1, 0, 1);
}

bool StyleWalker::free(int component) noexcept {
  if (component < 0 || component >= components()) return false;
  return set(pinned_[static_cast<std::size_t>(component)], 0, 0, 1);
}

bool StyleWalker::set_cadence(float steps_per_second) noexcept {
  if (!std::isfinite(steps_per_second)) return false;
  cadence_ = std::clamp(steps_per_second, 0.0f, 8.0f);
  return true;
}

void StyleWalker::mix_styles() noexcept {
  const Eigen::VectorXf& weights = mix_.weights();
  mean_.noalias() = tables_->means * weights;
  // Of independent draws of each style, weighted: half-way between two, less than either varies.
  deviation_.noalias() = tables_->deviations.cwiseAbs2() * weights.cwiseAbs2();
  deviation_ = deviation_.cwiseSqrt();
  limit_.noalias() = tables_->limits * weights;
  range_.noalias() = tables_->ranges * weights;
  const float duration = mean_[components()];
  mean_ = tables_->overall + exaggeration_.value() * (mean_ - tables_->overall);
  // Durations by their ratio: twice in a hurry is fast, not instant.
  const float usual = tables_->overall[components()];
  mean_[components()] = std::clamp(usual * std::pow(duration / usual, exaggeration_.value()),
                                   tables_->shortest, tables_->longest);
  range_.array() += mean_[components()] - duration;
}

// In deviations: the limit, and for durations the observed range.
DrawBounds StyleWalker::bounds(int i) const noexcept {
  DrawBounds bounds;
  if (deviation_[i] > 0) bounds.limit = std::min<double>(limit_[i] / deviation_[i], bounds.limit);
  const float deviation = variation_.value() * deviation_[i];
  if (i < components() || deviation <= 0) return bounds;
  bounds.lowest = std::max<double>(bounds.lowest, (range_[0] - mean_[i]) / deviation);
  bounds.highest = std::min<double>(bounds.highest, (range_[1] - mean_[i]) / deviation);
  return bounds;
}

void StyleWalker::draw_first_cycle() noexcept {
  const int count = static_cast<int>(mean_.size());
  draws_.rewind();
  for (int i = 0; i < count; ++i) draws_.draw_first(i, bounds(i));
  // Each number is at rest already; some cycles until they go together.
  constexpr int cycles = 8;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    draws_.turn_over();
    drawn_ = 0;
    draw_next(count);
  }
  draws_.turn_over();
  drawn_ = 0;
}

// A few numbers a frame, so that no frame takes much longer than another.
void StyleWalker::draw_next(int count) noexcept {
  const Eigen::VectorXf& weights = mix_.weights();
  for (; drawn_ < std::min(count, static_cast<int>(mean_.size())); ++drawn_) {
    row_.head(drawn_ + 1).setZero();
    for (std::size_t style = 0; style < tables_->together.size(); ++style)
      if (const float weight = weights[static_cast<Eigen::Index>(style)]; weight > 0)
        row_.head(drawn_ + 1) += weight * tables_->together[style].col(drawn_).head(drawn_ + 1);
    draws_.draw(drawn_, draws_.uniform(drawn_, row_), bounds(drawn_));
  }
}

float StyleWalker::duration() const noexcept {
  const int i = components();
  // The range again: variation or style may have changed since the draw.
  const float drawn = mean_[i] + variation_.value() * deviation_[i] * draws_.current()[i];
  return std::clamp(std::clamp(drawn, range_[0], range_[1]), tables_->shortest, tables_->longest);
}

double StyleWalker::frequency() const noexcept {
  return cadence_ > 0 ? 0.5 * cadence_ : 1.0 / duration();
}

float StyleWalker::cadence() const noexcept { return static_cast<float>(2 * frequency()); }

bool StyleWalker::scrub(double phase) noexcept {
  if (!(phase >= 0 && phase < 1)) return false;
  moved_ = true;
  contact_.reset();
  phase_ = phase;
  draw_next(static_cast<int>(phase_ / drawing * static_cast<double>(mean_.size())) + 1);
  show();
  return true;
}

bool StyleWalker::advance(double seconds) noexcept {
  if (!(seconds >= 0) || !std::isfinite(seconds)) return false;
  moved_ = true;
  contact_.reset();
  const double rate = frequency();
  const double passed = std::min(seconds * rate, 0.5), before = phase_;
  phase_ += passed;
  if (before < 0.5 && phase_ >= 0.5) {
    contact_ = Foot::left;
    since_contact_ = (phase_ - 0.5) / rate;
  }
  const auto way = static_cast<float>(passed);
  const float share = glide_share(way, step);
  mix_.advance(way);
  variation_.advance(share), exaggeration_.advance(share);
  for (Glide& glide : pinned_) glide.advance(share);
  for (Glide& glide : pin_values_) glide.advance(share);
  mix_styles();
  if (phase_ >= 1) {
    since_contact_ = (phase_ - 1) / rate;
    contact_ = Foot::right;
    ++cycle_;
    draw_next(static_cast<int>(mean_.size()));
    draws_.turn_over();
    drawn_ = 0;
    // What is left of this frame passes at the new cycle's rate.
    phase_ = std::min(since_contact_ * frequency(), 0.4999);
  }
  draw_next(static_cast<int>(phase_ / drawing * static_cast<double>(mean_.size())) + 1);
  show();
  return true;
}

void StyleWalker::show() noexcept {
  const auto next = static_cast<float>(smoothstep(1 - join, 1.0, phase_));
  const float variation = variation_.value();
  for (int i = 0; i < components(); ++i) {
    const float z = draws_.current()[i] + next * (draws_.next()[i] - draws_.current()[i]);
    const auto place = static_cast<std::size_t>(i);
    const float drawn = mean_[i] + variation * deviation_[i] * z;
    const float held = pin_values_[place].value() * tables_->component_deviations[i];
    scores_[i] = drawn + pinned_[place].value() * (held - drawn);
  }
  cycle_pose_.read(phase_, scores_, pose_);
  tables_->hinges.apply(pose_);
}

}  // namespace gait
