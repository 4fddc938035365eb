#include "gait/play/recognise/style_recogniser.h"

#include <cmath>

namespace gait {

StyleRecogniser::StyleRecogniser(const Model& model, std::shared_ptr<const StateTables> tables)
    : tables_(std::move(tables)),
      layout_(model.input),
      kept_(model.input.size()),
      score_(Eigen::VectorXf::Zero(static_cast<Eigen::Index>(model.styles.size()))),
      scores_(Eigen::VectorXf::Zero(PackedMap::padded(static_cast<int>(model.styles.size())))),
      averaged_(score_),
      posteriors_(score_),
      frame_rate_(model.frame_rate),
      temper_(static_cast<float>(model.play.style_temper)) {
  set_memory(static_cast<float>(model.play.style_memory));
  reset();
}

void StyleRecogniser::set_memory(float seconds) noexcept {
  keep_ = seconds > 0 ? static_cast<float>(std::exp(-1 / (seconds * frame_rate_))) : 0.0f;
}

void StyleRecogniser::reset() noexcept {
  averaged_.setZero();
  if (posteriors_.size() > 0)
    posteriors_.setConstant(1.0f / static_cast<float>(posteriors_.size()));
  best_ = posteriors_.size() > 0 ? 0 : -1;
}

void StyleRecogniser::advance(std::span<const WeightedState> states,
                              const Eigen::Ref<const Eigen::VectorXf>& x, int known) noexcept {
  if (posteriors_.size() == 0) return;
  const int depth = tables_->depth_of(known, layout_);
  kept_.take(*tables_, x);
  score_.setZero();
  for (const WeightedState& weighted : states) {
    const PlayedState& state = tables_->states[weighted.state];
    state.style_scores[depth].apply(kept_.kept().data(), tables_->depths[depth], scores_.data());
    score_ += weighted.weight * scores_.head(score_.size());
  }
  // What all styles share says nothing about them; without it the numbers stay small.
  score_.array() -= score_.mean();
  averaged_ = keep_ * averaged_ + (1 - keep_) * score_;
  posteriors_ = (temper_ * (averaged_.array() - averaged_.maxCoeff(&best_))).exp();
  posteriors_ /= posteriors_.sum();
}

}  // namespace gait
