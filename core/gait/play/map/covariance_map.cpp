#include "gait/play/map/covariance_map.h"

#include <cmath>

namespace gait {

namespace {

constexpr float least_difference_variance = 1e-5f;  // as a share of the static's

}  // namespace

CovarianceMap::CovarianceMap(const Model& model, std::shared_ptr<const StateTables> tables)
    : tables_(std::move(tables)),
      layout_(model.input),
      whitening_(model.input.size()),
      scale_(model.output_scaling.deviation.cast<float>()),
      offset_(model.output_scaling.mean.cast<float>()),
      strength_(Eigen::VectorXf::Constant(model.output.statics(),
                                          static_cast<float>(model.play.strength))) {
  const int outputs = model.output.size();
  shift_ = Eigen::VectorXf::Zero(PackedMap::padded(outputs));
  for (Eigen::VectorXf* scratch : {&mean_, &squares_, &variance_, &mapped_.mean, &mapped_.variance})
    *scratch = Eigen::VectorXf::Zero(outputs);
}

const OutputGaussian& CovarianceMap::map(std::span<const WeightedState> states,
                                         const Eigen::Ref<const Eigen::VectorXf>& x,
                                         int known) noexcept {
  const int depth = tables_->depth_of(known, layout_);
  whitening_.take(*tables_, x);
  return mix(states, depth, [&](int state) {
    return whitening_.innovation(tables_->states[state], tables_->depths[depth]);
  });
}

const OutputGaussian& CovarianceMap::map(const Recogniser& decided) noexcept {
  tables_ = decided.tables();
  if (!decided.whitened()) return map(decided.states(), decided.scaled(), decided.known());
  return mix(decided.states(), tables_->depth_of(decided.known(), layout_),
             [&](int state) { return decided.innovation(state); });
}

template <class InnovationOf>
const OutputGaussian& CovarianceMap::mix(std::span<const WeightedState> states, int depth,
                                         InnovationOf innovation_of) noexcept {
  const int count = tables_->depths[depth];
  mean_.setZero();
  squares_.setZero();
  variance_.setZero();
  distance_ = 0;
  const Eigen::Index statics = strength_.size();
  for (const WeightedState& weighted : states) {
    const PlayedState& state = tables_->states[weighted.state];
    const auto innovation = innovation_of(weighted.state);
    distance_ += weighted.weight * std::sqrt(innovation.squaredNorm() / static_cast<float>(count));
    state.gain.apply(innovation.data(), count, shift_.data());
    for (int part = 0; part < 3; ++part) {
      const auto at = [&](auto& vector) { return vector.segment(part * statics, statics).array(); };
      const auto s = strength_.array();
      auto moved = shift_.segment(part * statics, statics).array();
      moved = at(state.output_mean) + s * moved;
      auto mean = mean_.segment(part * statics, statics).array();
      auto squares = squares_.segment(part * statics, statics).array();
      auto variance = variance_.segment(part * statics, statics).array();
      mean += weighted.weight * moved;
      squares += weighted.weight * moved.square();
      variance +=
          weighted.weight *
          (at(state.output_variance) -
           s * (2 - s) *
               state.explained_variance.col(depth).segment(part * statics, statics).array());
    }
  }
  // Variance within the states plus that of their means about the mixture's.
  variance_.array() += (squares_.array() - mean_.array().square()).max(0.0f);
  mapped_.mean = scale_.cwiseProduct(mean_) + offset_;
  mapped_.variance = scale_.cwiseAbs2().cwiseProduct(variance_.cwiseMax(1e-6f));
  // Differences surer than this against the statics would cost the trajectory's float its digits.
  for (int part = 1; part < 3; ++part) {
    auto variance = mapped_.variance.segment(part * statics, statics);
    variance = variance.cwiseMax(least_difference_variance * mapped_.variance.head(statics));
  }
  return mapped_;
}

}  // namespace gait
