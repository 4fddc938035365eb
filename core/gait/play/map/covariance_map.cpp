#include "gait/play/map/covariance_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gait {

namespace {

constexpr float least_difference_variance = 1e-5f;  // as a share of the static's

}  // namespace

CovarianceMap::CovarianceMap(const Model& model, std::shared_ptr<const StateTables> tables)
    : tables_(std::move(tables)),
      layout_(model.input),
      whitening_(model.input.size()),
      clipped_(Eigen::VectorXf::Zero(model.input.size())),
      distances_(Decoder::most_weighted),
      scale_(model.output_scaling.deviation.cast<float>()),
      offset_(model.output_scaling.mean.cast<float>()),
      statics_(model.output.statics()),
      trusted_(model.play.trust ? static_cast<float>(*model.play.trust * model.play.usual_distance)
                                : std::numeric_limits<float>::max()),
      strength_(Eigen::VectorXf::Zero(model.output.size())) {
  set_strength(static_cast<float>(model.play.strength));
  const int outputs = model.output.size();
  shift_ = Eigen::VectorXf::Zero(PackedMap::padded(outputs));
  for (Eigen::VectorXf* scratch : {&mean_, &squares_, &variance_, &mapped_.mean, &mapped_.variance})
    *scratch = Eigen::VectorXf::Zero(outputs);
}

void CovarianceMap::set_strength(float strength) noexcept {
  for (int value = 0; value < statics_; ++value) set_strength(value, strength);
}

void CovarianceMap::set_strength(int value, float strength) noexcept {
  for (int at = value; at < strength_.size(); at += statics_) strength_[at] = strength;
}

const OutputGaussian& CovarianceMap::map(std::span<const WeightedState> states,
                                         const Eigen::Ref<const Eigen::VectorXf>& x,
                                         int known) noexcept {
  const int depth = tables_->depth_of(known, layout_), count = tables_->depths[depth];
  clipped_ = x;
  const bool clipped = clip_observation(layout_, known, clipped_);
  if (clipped) whitening_.take(*tables_, x);
  for (std::size_t i = 0; clipped && i < states.size(); ++i)
    distances_[i] = whitening_.distance(tables_->states[states[i].state], count);
  whitening_.take(*tables_, clipped_);
  return mix(states, depth, clipped ? distances_.data() : nullptr,
             [&](int state) { return whitening_.innovation(tables_->states[state], count); });
}

const OutputGaussian& CovarianceMap::map(const Recogniser& decided) noexcept {
  tables_ = decided.tables();
  if (!decided.whitened()) return map(decided.states(), decided.unclipped(), decided.known());
  return mix(decided.states(), tables_->depth_of(decided.known(), layout_),
             decided.distances().data(), [&](int state) { return decided.innovation(state); });
}

template <class InnovationOf>
const OutputGaussian& CovarianceMap::mix(std::span<const WeightedState> states, int depth,
                                         const float* distances,
                                         InnovationOf innovation_of) noexcept {
  const int count = tables_->depths[depth];
  distance_ = 0;
  const bool several = states.size() > 1 || states.front().weight != 1;
  for (const WeightedState& weighted : states) {
    const PlayedState& state = tables_->states[weighted.state];
    const auto innovation = innovation_of(weighted.state);
    const float distance =
        distances ? *distances++ : std::sqrt(innovation.squaredNorm() / static_cast<float>(count));
    distance_ += weighted.weight * distance;
    // Far from what was taught the gains lead anywhere: what is mapped then falls with distance.
    const float near = std::min(1.0f, trusted_ / distance), trust = near * near;
    state.gain.apply(innovation.data(), count, shift_.data());
    auto moved = shift_.head(mean_.size());
    moved = state.output_mean + trust * strength_.cwiseProduct(moved);
    const auto certainty = trust * strength_.array() * (2 - trust * strength_.array());
    const auto within = state.output_variance -
                        certainty.matrix().cwiseProduct(state.explained_variance.col(depth));
    if (&weighted == states.data()) {
      mean_ = weighted.weight * moved;
      variance_ = weighted.weight * within;
      if (several) squares_ = weighted.weight * moved.cwiseAbs2();
    } else {
      mean_ += weighted.weight * moved;
      variance_ += weighted.weight * within;
      squares_ += weighted.weight * moved.cwiseAbs2();
    }
  }
  // Variance within the states plus that of their means about the mixture's.
  if (several) variance_.array() += (squares_.array() - mean_.array().square()).max(0.0f);
  mapped_.mean = scale_.cwiseProduct(mean_) + offset_;
  mapped_.variance = scale_.cwiseAbs2().cwiseProduct(variance_.cwiseMax(1e-6f));
  // Differences are never surer than this against the statics, which would have no say any more.
  for (int part = 1; part < 3; ++part) {
    auto variance = mapped_.variance.segment(part * statics_, statics_);
    variance = variance.cwiseMax(least_difference_variance * mapped_.variance.head(statics_));
  }
  return mapped_;
}

}  // namespace gait
