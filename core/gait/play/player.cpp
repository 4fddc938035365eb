#include "gait/play/player.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

int frames_in(double seconds, double frame_rate) {
  return std::max(0, static_cast<int>(std::lround(seconds * frame_rate)));
}

int history_of(const Model& model) {
  return model.input.lags.empty() ? 0 : model.input.lags.back();
}

Decoder decoder_for(const Model& model, const PlayerSettings& settings,
                    std::shared_ptr<const StateTables> tables) {
  return Decoder(std::move(tables), settings.decoder.value_or(model.play.decoder),
                 frames_in(settings.lag.value_or(model.play.lag), model.frame_rate),
                 static_cast<float>(settings.temper.value_or(model.play.temper)), model.frame_rate);
}

Trajectory trajectory_for(const Model& model, const PlayerSettings& settings) {
  return Trajectory(
      model.output.statics(), settings.past.value_or(frames_in(model.play.past, model.frame_rate)),
      settings.current, settings.future.value_or(frames_in(model.play.future, model.frame_rate)));
}

PhaseClockSettings clock_settings(const Model& model, const PhaseEstimator& phase) {
  PhaseClockSettings settings;
  if (model.labels.empty()) return settings;
  settings.steps = std::clamp(phase.labels_in_cycle(0), 1, 64);
  const double cadence = phase.mean_cadence(0), cycles = cadence / settings.steps;
  if (!(cycles > 0)) return settings;
  settings.cadence = cadence;
  // Gestures may be far slower or faster than steps.
  settings.slowest = std::min(settings.slowest, cycles / 4);
  settings.fastest = std::max(settings.fastest, cycles * 4);
  return settings;
}

}  // namespace

Player::Player(std::shared_ptr<const Model> model, const PlayerSettings& settings,
               std::shared_ptr<const StateTables> tables)
    : model_(std::move(model)),
      tables_(tables ? std::move(tables) : make_state_tables(*model_)),
      observer_(model_->input, model_->input_scaling),
      emissions_(tables_, model_->input),
      decoder_(decoder_for(*model_, settings, tables_)),
      phase_(*model_),
      clock_(clock_settings(*model_, phase_)),
      cyclic_(phase_.labels_in_cycle(0) == static_cast<int>(model_->labels.size())),
      styles_(*model_, tables_),
      map_(*model_, tables_),
      trajectory_(trajectory_for(*model_, settings)),
      maker_(model_),
      values_(model_->input.values, 0.0f),
      missing_(values_.size(), false),
      returned_(values_.size(), history_of(*model_) + 1),
      wanted_(values_.size(), false),
      masked_(values_.size(), false) {
  if (settings.strength) map_.set_strength(static_cast<float>(*settings.strength));
  if (settings.style_memory) styles_.set_memory(static_cast<float>(*settings.style_memory));
  const int waiting = decoder_.lag() + trajectory_.delay() + 1;
  Held empty;
  empty.x = Eigen::VectorXf::Zero(model_->input.size());
  empty.styles.assign(model_->styles.size(), 0.0f);
  ring_.assign(waiting + 1, empty);
  output_slots_.assign(waiting, 0);
  outputs_ = model_->output_mean.cast<float>().replicate(1, waiting);
}

void Player::reset() noexcept {
  observer_.reset();
  decoder_.reset();
  styles_.reset();
  trajectory_.reset();
  clock_.reset();
  taken_ = mapped_ = emitted_ = available_ = 0;
  latest_ = {};
}

int Player::slot(int back) const noexcept {
  const int size = static_cast<int>(ring_.size());
  return (newest_ - back + size) % size;
}

std::span<const float> Player::output(int i) const noexcept {
  return {outputs_.col(i).data(), static_cast<std::size_t>(outputs_.rows())};
}
const Decision& Player::decision(int i) const noexcept { return ring_[output_slots_[i]].decision; }
std::span<const float> Player::styles(int i) const noexcept {
  return ring_[output_slots_[i]].styles;
}

void Player::set_missing(int value, bool missing) noexcept { missing_[value] = missing; }

void Player::hold_missing(std::span<const float> values) noexcept {
  const int history = history_of(*model_);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    // What is not a number would stay in the decoder's paths for ever.
    const bool there = !missing_[i] && std::isfinite(values[i]);
    if (there) values_[i] = values[i];
    if (missing_[i])
      returned_[i] = 0;
    else
      returned_[i] = std::min(returned_[i] + 1, history + 1);
    // One that came back is left out until its differences no longer reach into the gap.
    wanted_[i] = returned_[i] <= history;
  }
}

void Player::keep_tables_current() noexcept {
  if (maker_.finished()) {
    if (const auto fresh = maker_.ready()) {
      emissions_.use(fresh);
      decoder_.use(fresh);
      styles_.use(fresh);
      map_.use(fresh);
    }
    maker_.take(tables_);
    awaiting_ = false;
  }
  if (wanted_ != masked_ && maker_.ask(wanted_)) {
    awaiting_ = true;
    for (std::size_t i = 0; i < wanted_.size(); ++i) masked_[i] = wanted_[i];
  }
}

void Player::advance(std::span<const float> values) noexcept {
  available_ = 0;
  hold_missing(values);
  keep_tables_current();
  observer_.advance(values_);
  newest_ = (newest_ + 1) % static_cast<int>(ring_.size());
  ++taken_;
  Held& held = ring_[newest_];
  held.x = observer_.scaled();
  held.known = observer_.known();
  decoder_.advance(emissions_.of(held.x, held.known));
  if (decoder_.decided())
    decide(decoder_.lag(), decoder_.state(), decoder_.weighted(), decoder_.progress());
}

void Player::decide(int back, int state, std::span<const WeightedState> states,
                    float progress) noexcept {
  Held& held = ring_[slot(back)];
  const int label = tables_->states[state].label;
  styles_.advance(states, held.x, held.known);
  const OutputGaussian& gaussian = map_.map(states, held.x, held.known);
  held.decision.label = label;
  held.decision.state = state - tables_->first_state[label];
  held.decision.log_likelihood = decoder_.log_likelihood();
  held.decision.progress = progress;
  held.decision.distance = map_.distance();
  follow_phase(states, held.decision);
  std::copy(styles_.posteriors().begin(), styles_.posteriors().end(), held.styles.begin());
  latest_ = held.decision;
  trajectory_.push(gaussian);
  ++mapped_;
  if (trajectory_.ready()) emit(trajectory_.generate());
}

void Player::follow_phase(std::span<const WeightedState> states, Decision& decision) noexcept {
  const PhaseEstimate estimate = phase_.of(states, decision.progress);
  decision.phase = estimate.phase;
  decision.cadence = phase_.mean_cadence(decision.label);
  if (!cyclic_) return;
  clock_.advance(1 / model_->frame_rate);
  clock_.observe(estimate.seen, estimate.certainty, estimate.age);
  decision.phase = clock_.phase();
  decision.cadence = clock_.cadence();
}

void Player::emit(const Eigen::Ref<const Eigen::MatrixXf>& statics) noexcept {
  for (Eigen::Index i = 0; i < statics.cols(); ++i) {
    for (Eigen::Index value = 0; value < statics.rows(); ++value)
      outputs_(model_->output.modelled[static_cast<std::size_t>(value)], available_) =
          statics(value, i);
    output_slots_[available_++] = slot(taken_ - 1 - emitted_);
    ++emitted_;
  }
}

bool Player::flush() noexcept {
  available_ = 0;
  while (mapped_ < taken_ && available_ == 0) {
    const int back = taken_ - 1 - mapped_;
    const WeightedState state{decoder_.state_at_end(back), 1};
    decide(back, state.state, {&state, 1}, decoder_.progress_at_end(back));
  }
  if (available_ == 0 && emitted_ < mapped_) emit(trajectory_.flush(mapped_ - emitted_));
  return available_ > 0;
}

}  // namespace gait
