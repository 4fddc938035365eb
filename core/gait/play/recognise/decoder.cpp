#include "gait/play/recognise/decoder.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

constexpr float negligible_weight = 0.005f;

}  // namespace

Decoder::Decoder(std::shared_ptr<const StateTables> tables, DecoderKind kind, int lag, float temper,
                 double frame_rate)
    : tables_(std::move(tables)),
      kind_(kind),
      lag_(std::max(0, lag)),
      temper_(temper),
      frame_rate_(frame_rate),
      weighted_(most_weighted) {
  const int states = static_cast<int>(tables_->states.size());
  predecessors_.resize(states);
  log_arrive_.assign(states, 0.0f);
  for (int label = 0; label < tables_->labels(); ++label) {
    const int first = tables_->first_state[label];
    const int end = label + 1 < tables_->labels() ? tables_->first_state[label + 1] : states;
    for (int state = first + 1; state < end; ++state) predecessors_[state].push_back(state - 1);
    const auto& successors = tables_->successors[label];
    for (const int next : successors) predecessors_[tables_->first_state[next]].push_back(end - 1);
    // Leaving the last state means choosing among the labels that may follow.
    log_arrive_[end - 1] =
        -std::log(static_cast<float>(std::max<std::size_t>(1, successors.size())));
  }
  scores_.resize(states);
  before_.resize(states);
  // The frame before the newest is always needed.
  const int columns = std::max(2, kind == DecoderKind::lag ? lag_ + 1 : 0);
  came_from_.resize(states, columns);
  time_.resize(states, columns);
  reset();
}

void Decoder::reset() noexcept {
  scores_.setZero();
  time_.setZero();
  came_from_.setZero();
  frames_ = newest_ = weighted_count_ = state_ = 0;
  log_likelihood_ = progress_ = 0;
}

void Decoder::advance(std::span<const float> emissions) noexcept {
  newest_ = (newest_ + 1) % static_cast<int>(came_from_.cols());
  kind_ == DecoderKind::forward ? filter(emissions) : viterbi(emissions);
  progress_ = progress_of(state_, std::min(lag(), frames_));
  ++frames_;
}

void Decoder::viterbi(std::span<const float> emissions) noexcept {
  const int states = static_cast<int>(scores_.size());
  const int previous = column(1);
  before_ = scores_;
  for (int state = 0; state < states; ++state) {
    int best_from = state;
    float best = before_[state] + (frames_ == 0 ? 0 : tables_->states[state].log_stay);
    if (frames_ > 0)
      for (const int from : predecessors_[state]) {
        const float score = before_[from] + tables_->states[from].log_leave + log_arrive_[from];
        if (score > best) best = score, best_from = from;
      }
    scores_[state] = best + emissions[state];
    time_(state, newest_) = best_from == state ? time_(state, previous) + 1 : 1;
    came_from_(state, newest_) = best_from;
  }
  int newest = 0;
  log_likelihood_ = scores_.maxCoeff(&newest);
  scores_.array() -= log_likelihood_;
  state_ = kind_ == DecoderKind::lag ? state_back(std::min(lag_, frames_)) : newest;
  weighted_[0] = {state_, 1};
  weighted_count_ = 1;
}

int Decoder::column(int back) const noexcept {
  const int columns = static_cast<int>(came_from_.cols());
  return (newest_ - back + columns) % columns;
}

int Decoder::state_back(int back) const noexcept {
  int state = 0;
  scores_.maxCoeff(&state);
  for (int i = 0; i < back; ++i) state = came_from_(state, column(i));
  return state;
}

// scores_ holds log posteriors of the frame before; emissions are tempered, transitions are not.
void Decoder::filter(std::span<const float> emissions) noexcept {
  const int states = static_cast<int>(scores_.size());
  const int previous = column(1);
  before_ = scores_.array().exp();
  for (int state = 0; state < states; ++state) {
    float arrived = frames_ == 0 ? 1 / static_cast<float>(states)
                                 : before_[state] * std::exp(tables_->states[state].log_stay);
    float most = arrived;
    int best_from = state;
    if (frames_ > 0)
      for (const int from : predecessors_[state]) {
        const float came =
            before_[from] * std::exp(tables_->states[from].log_leave + log_arrive_[from]);
        arrived += came;
        if (came > most) most = came, best_from = from;
      }
    scores_[state] = std::log(std::max(arrived, 1e-30f)) + temper_ * emissions[state];
    time_(state, newest_) = best_from == state ? time_(state, previous) + 1 : 1;
  }
  const float largest = scores_.maxCoeff(&state_);
  const float sum = (scores_.array() - largest).exp().sum();
  log_likelihood_ = largest + std::log(sum);
  scores_.array() -= log_likelihood_;
  weigh();
}

// Names the states that count, the likeliest first.
void Decoder::weigh() noexcept {
  weighted_count_ = 1;
  weighted_[0] = {state_, std::exp(scores_[state_])};
  float total = weighted_[0].weight;
  for (int state = 0; state < static_cast<int>(scores_.size()); ++state) {
    if (state == state_) continue;
    const float weight = std::exp(scores_[state]);
    if (weight < negligible_weight) continue;
    int place = weighted_count_;
    if (weighted_count_ == most_weighted) {
      // Full: the least of those kept makes room, if it weighs less.
      place = static_cast<int>(
          std::min_element(weighted_.begin(), weighted_.end(),
                           [](const auto& a, const auto& b) { return a.weight < b.weight; }) -
          weighted_.begin());
      if (weighted_[place].weight >= weight) continue;
      total -= weighted_[place].weight;
    } else {
      ++weighted_count_;
    }
    weighted_[place] = {state, weight};
    total += weight;
  }
  for (int i = 0; i < weighted_count_; ++i) weighted_[i].weight /= total;
}

float Decoder::progress_of(int state, int back) const noexcept {
  const PlayedState& played = tables_->states[state];
  // A token that arrived at this frame came half a frame ago, on average.
  const float time = static_cast<float>((time_(state, column(back)) - 0.5) / frame_rate_);
  const float whole = tables_->label_duration[played.label];
  return whole > 0 ? std::min(1.0f, (played.before + std::min(time, played.mean_duration)) / whole)
                   : 0.0f;
}

}  // namespace gait
