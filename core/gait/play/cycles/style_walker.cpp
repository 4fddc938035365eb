#include "gait/play/cycles/style_walker.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "gait/error.h"
#include "gait/motion/smoothing.h"

namespace gait {

namespace {

constexpr double join = 0.1;            // of the phase: over which one cycle becomes the next
constexpr double drawing = 0.75;        // of the phase: over which the next cycle is drawn
constexpr double of_its_own = 0.1;      // share of each number's variance that is its own
constexpr float step = 0.5f;            // cycles: over which a control arrives
constexpr float beyond_styles = 0.25f;  // of all styles' range: exaggerated durations stay within
constexpr float beyond_range = 0.1f;    // of the observed range's ends: durations stay within

std::vector<bool> can_walk(const StyleSpace& space) {
  std::vector<bool> can;
  for (const StyleCycles& style : space.styles) can.push_back(style.cycles > 0);
  return can;
}

Eigen::VectorXf even_weights(const StyleSpace& space) {
  Eigen::VectorXf weights(static_cast<Eigen::Index>(space.styles.size()));
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    weights[i] = space.styles[static_cast<std::size_t>(i)].cycles > 0 ? 1.0f : 0.0f;
  return weights / weights.sum();
}

Eigen::VectorXf neutral_weights(const Model& model) {
  const StyleSpace& space = *model.style_space;
  for (std::size_t i = 0; i < model.styles.size(); ++i)
    if ((model.styles[i] == "neutral" || model.styles[i] == "normal") && space.styles[i].cycles > 0)
      return Eigen::VectorXf::Unit(static_cast<Eigen::Index>(model.styles.size()),
                                   static_cast<Eigen::Index>(i));
  return even_weights(space);
}

}  // namespace

StyleWalker::StyleWalker(const PlayModel& played, std::uint64_t seed)
    : cycle_pose_(played.cycles()),
      mix_(can_walk(*played.model->style_space), neutral_weights(*played.model)),
      hinges_(*played.model->body),
      draws_(played.model->style_space->space.kept() + 1, seed) {
  const StyleSpace& space = *played.model->style_space;
  const int components = space.space.kept();
  const auto styles = static_cast<Eigen::Index>(space.styles.size());
  means_ = deviations_ = limits_ = Eigen::MatrixXf::Zero(components + 1, styles);
  ranges_ = Eigen::MatrixXf::Zero(2, styles);
  for (Eigen::Index s = 0; s < styles; ++s) {
    const StyleCycles& style = space.styles[static_cast<std::size_t>(s)];
    for (int i = 0; i <= components; ++i) {
      const Variation& variation =
          i < components ? style.scores[static_cast<std::size_t>(i)] : style.duration;
      means_(i, s) = static_cast<float>(variation.mean);
      deviations_(i, s) = static_cast<float>(variation.deviation);
      limits_(i, s) = static_cast<float>(variation.largest_change);
    }
    const Eigen::MatrixXd shrunk =
        (1 - of_its_own) * style.correlation +
        of_its_own * Eigen::MatrixXd::Identity(components + 1, components + 1);
    const Eigen::LLT<Eigen::MatrixXd> factor(shrunk);
    together_.push_back(Eigen::MatrixXd(factor.matrixU()).cast<float>());
    ranges_(0, s) = static_cast<float>(style.duration.lowest) * (1 - beyond_range);
    ranges_(1, s) = static_cast<float>(style.duration.highest) * (1 + beyond_range);
  }
  overall_ = means_ * even_weights(space);
  shortest_ = longest_ = overall_[components];
  for (Eigen::Index s = 0; s < styles; ++s) {
    if (space.styles[static_cast<std::size_t>(s)].cycles == 0) continue;
    shortest_ = std::min(shortest_, ranges_(0, s) * (1 - beyond_styles));
    longest_ = std::max(longest_, ranges_(1, s) * (1 + beyond_styles));
  }
  mean_ = deviation_ = limit_ = row_ = overall_;
  range_ = Eigen::VectorXf::Zero(2);
  component_deviations_ = space.space.variances.head(components).cwiseSqrt().cast<float>();
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
  mean_.noalias() = means_ * weights;
  // Of independent draws of each style, weighted: half-way between two, less than either varies.
  deviation_.noalias() = deviations_.cwiseAbs2() * weights.cwiseAbs2();
  deviation_ = deviation_.cwiseSqrt();
  limit_.noalias() = limits_ * weights;
  range_.noalias() = ranges_ * weights;
  const float duration = mean_[components()];
  mean_ = overall_ + exaggeration_.value() * (mean_ - overall_);
  // Durations by their ratio: twice in a hurry is fast, not instant.
  const float usual = overall_[components()];
  mean_[components()] =
      std::clamp(usual * std::pow(duration / usual, exaggeration_.value()), shortest_, longest_);
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
    for (std::size_t style = 0; style < together_.size(); ++style)
      if (const float weight = weights[static_cast<Eigen::Index>(style)]; weight > 0)
        row_.head(drawn_ + 1) += weight * together_[style].col(drawn_).head(drawn_ + 1);
    draws_.draw(drawn_, draws_.uniform(drawn_, row_), bounds(drawn_));
  }
}

float StyleWalker::duration() const noexcept {
  const int i = components();
  // The range again: variation or style may have changed since the draw.
  const float drawn = mean_[i] + variation_.value() * deviation_[i] * draws_.current()[i];
  return std::clamp(std::clamp(drawn, range_[0], range_[1]), shortest_, longest_);
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
    const float held = pin_values_[place].value() * component_deviations_[i];
    scores_[i] = drawn + pinned_[place].value() * (held - drawn);
  }
  cycle_pose_.read(phase_, scores_, pose_);
  hinges_.apply(pose_);
}

}  // namespace gait
