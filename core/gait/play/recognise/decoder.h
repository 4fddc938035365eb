// Decoder: which state is it now (T14 §4.1), from log-likelihoods frame by frame.
//
// Three ways: forward-only Viterbi (the best state so far is the decision), the forward filter
// (posteriors; emissions tempered, since correlated dimensions are far too sure of themselves), and
// Viterbi with a fixed lag. It knows nothing of feet: labels and who follows whom come from the
// model.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "gait/play/recognise/state_tables.h"

namespace gait {

struct WeightedState {
  int state = 0;     // over all labels
  float weight = 1;  // sums to one over a decision's states
};

class Decoder {
 public:
  static constexpr int most_weighted = 8;  // states a decision can name

  // `lag`: frames, for DecoderKind::lag only.
  Decoder(std::shared_ptr<const StateTables> tables, DecoderKind kind, int lag, float temper,
          double frame_rate);

  // Scores a frame: `emissions` has the log-likelihood of x in each state.
  void advance(std::span<const float> emissions) noexcept;

  // Speaks of the frame `lag()` frames before the last one given.
  int state() const noexcept { return state_; }
  int label() const noexcept { return tables_->states[state_].label; }
  // The states of the decision with their weights, the likeliest first: one for Viterbi, those that
  // count for the filter.
  std::span<const WeightedState> weighted() const noexcept {
    return {weighted_.data(), static_cast<std::size_t>(weighted_count_)};
  }
  // Of the last frame: log-likelihood of x given what came before (filter), or of the best path's
  // last link (Viterbi).
  float log_likelihood() const noexcept { return log_likelihood_; }
  // Share of the label's mean duration that has passed at the frame decided on, 0 to 1, by the
  // decided state and the time its token has spent in it.
  float progress() const noexcept { return progress_; }
  // Frames by which the decision is late, and whether there is a decision yet.
  int lag() const noexcept { return kind_ == DecoderKind::lag ? lag_ : 0; }
  bool decided() const noexcept { return frames_ > lag(); }

  // After the last frame: the state `back` frames before it on the best path, back <= lag() and
  // fewer than the frames given, and the progress there.
  int state_at_end(int back) const noexcept { return state_back(back); }
  float progress_at_end(int back) const noexcept { return progress_of(state_back(back), back); }

  // New tables of the same labels and states take over between frames; paths live on. The caller
  // keeps the old ones alive until every user has changed, so that nothing is freed here.
  void use(const std::shared_ptr<const StateTables>& tables) noexcept { tables_ = tables; }
  void reset() noexcept;

 private:
  void viterbi(std::span<const float> emissions) noexcept;
  void filter(std::span<const float> emissions) noexcept;
  void weigh() noexcept;
  int state_back(int back) const noexcept;
  float progress_of(int state, int back) const noexcept;
  int column(int back) const noexcept;

  std::shared_ptr<const StateTables> tables_;
  DecoderKind kind_;
  int lag_;
  float temper_;
  double frame_rate_;
  std::vector<std::vector<int>> predecessors_;  // per state, without itself
  std::vector<float> log_arrive_;               // per state: -log of how many labels may follow
  Eigen::VectorXf scores_, before_;             // log domain, largest 0
  // Rings of columns, one per frame: where the token in each state came from, and the frames it has
  // spent there.
  Eigen::MatrixXi came_from_, time_;
  std::vector<WeightedState> weighted_;
  int weighted_count_ = 0;
  int state_ = 0, frames_ = 0, newest_ = 0;
  float log_likelihood_ = 0, progress_ = 0;
};

}  // namespace gait
