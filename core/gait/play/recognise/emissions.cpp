#include "gait/play/recognise/emissions.h"

#include <cmath>

namespace gait {

Whitening::Whitening(int inputs)
    : kept_(Eigen::VectorXf::Zero(PackedMap::padded(inputs))), innovation_(kept_) {}

void Whitening::take(const StateTables& tables,
                     const Eigen::Ref<const Eigen::VectorXf>& x) noexcept {
  const auto kept = static_cast<Eigen::Index>(tables.kept.size());
  if (kept == x.size()) {
    kept_.head(kept) = x;
    return;
  }
  for (std::size_t i = 0; i < tables.kept.size(); ++i)
    kept_[static_cast<Eigen::Index>(i)] = x[tables.kept[i]];
}

Eigen::Map<const Eigen::VectorXf> Whitening::innovation(const PlayedState& state,
                                                        int count) noexcept {
  state.whitener.apply(kept_.data(), count, innovation_.data());
  return {innovation_.data(), count};
}

float Whitening::distance(const PlayedState& state, int count) noexcept {
  const float squared = state.whitener.apply(kept_.data(), count, innovation_.data());
  return std::sqrt(squared / static_cast<float>(count));
}

Emissions::Emissions(std::shared_ptr<const StateTables> tables, const InputLayout& layout)
    : tables_(std::move(tables)),
      layout_(layout),
      whitening_(layout.size()),
      log_likelihoods_(tables_->states.size()),
      squared_distances_(Eigen::VectorXf::Zero(static_cast<Eigen::Index>(log_likelihoods_.size()))),
      innovations_(Eigen::MatrixXf::Zero(whitening_.kept().size(), squared_distances_.size())) {}

std::span<const float> Emissions::of(const Eigen::Ref<const Eigen::VectorXf>& x,
                                     int known) noexcept {
  const int depth = tables_->depth_of(known, layout_);
  seen_ = tables_->depths[depth];
  whitening_.take(*tables_, x);
  for (std::size_t state = 0; state < tables_->states.size(); ++state) {
    const PlayedState& played = tables_->states[state];
    const auto column = static_cast<Eigen::Index>(state);
    const float squared =
        played.whitener.apply(whitening_.kept().data(), seen_, innovations_.col(column).data());
    squared_distances_[column] = squared;
    log_likelihoods_[state] = played.log_constant[depth] - 0.5f * squared;
  }
  return log_likelihoods_;
}

}  // namespace gait
