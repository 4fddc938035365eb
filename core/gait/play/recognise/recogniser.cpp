#include "gait/play/recognise/recogniser.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gait {

namespace {

int history_of(const Model& model) {
  return model.input.lags.empty() ? 0 : model.input.lags.back();
}

Decoder decoder_for(const Model& model, const RecogniserSettings& settings,
                    std::shared_ptr<const StateTables> tables) {
  const double lag = settings.lag.value_or(model.play.lag) * model.frame_rate;
  return Decoder(std::move(tables), settings.decoder.value_or(model.play.decoder),
                 std::max(0, static_cast<int>(std::lround(lag))),
                 static_cast<float>(settings.temper.value_or(model.play.temper)), model.frame_rate);
}

}  // namespace

PhaseClockSettings Recogniser::clock_settings_of(const Model& model, const PhaseEstimator& phase) {
  PhaseClockSettings settings;
  if (model.labels.empty()) return settings;
  settings.steps = std::clamp(phase.cycle(0).labels, 1, 64);
  const double cadence = phase.cycle(0).cadence(), cycles = cadence / settings.steps;
  if (!(cycles > 0)) return settings;
  settings.cadence = cadence;
  // Gestures may be far slower or faster than steps.
  settings.slowest = std::min(settings.slowest, cycles / 4);
  settings.fastest = std::max(settings.fastest, cycles * 4);
  return settings;
}

Recogniser::Recogniser(const PlayModel& played, const RecogniserSettings& settings)
    : model_(played.model),
      tables_(played.states()),
      current_(tables_),
      observer_(model_->input, model_->input_scaling),
      emissions_(tables_, model_->input),
      unclipped_(model_->input.size()),
      decoder_(decoder_for(*model_, settings, tables_)),
      phase_(*model_),
      late_whitening_(model_->input.size()),
      clock_(clock_settings_of(*model_, phase_)),
      cyclic_(phase_.cycle(0).labels == static_cast<int>(model_->labels.size())),
      styles_(*model_, tables_),
      maker_(model_),
      values_(model_->input.values, 0.0f),
      missing_(values_.size(), false),
      returned_(values_.size(), history_of(*model_) + 1),
      wanted_(values_.size(), false),
      masked_(values_.size(), false),
      states_(Decoder::most_weighted),
      distances_(Decoder::most_weighted),
      seen_phases_(states_.size()) {
  set_bounds();
  clock_.set_walking(true);  // frames are a walk until standing shows
  if (settings.style_memory) styles_.set_memory(static_cast<float>(*settings.style_memory));
  unseen_.reserve(values_.size());
  note_unseen();
  Held empty;
  empty.scaled = empty.unclipped = empty.raw = Eigen::VectorXf::Zero(model_->input.size());
  empty.squared_distances = Eigen::VectorXf::Zero(model_->states());
  ring_.assign(decoder_.lag() + 1, empty);
}

void Recogniser::reset() noexcept {
  observer_.reset();
  decoder_.reset();
  styles_.reset();
  clock_.reset();
  clock_.set_walking(true);
  taken_ = decided_ = decided_back_ = state_count_ = 0;
  decision_ = {};
  estimate_ = {};
}

const Recogniser::Held& Recogniser::held(int back) const noexcept {
  const int size = static_cast<int>(ring_.size());
  return ring_[(newest_ - back + size) % size];
}

// Sums of squares of what is further out would leave the range of floats, for ever. A deviation of
// a rotation is at least 1e-3 rad, so that every rotation there is stays within.
void Recogniser::set_bounds() {
  constexpr double farthest = 1e4;  // deviations
  lowest_ = Eigen::ArrayXf::Constant(model_->input.values, std::numeric_limits<float>::lowest());
  highest_ = Eigen::ArrayXf::Constant(model_->input.values, std::numeric_limits<float>::max());
  const Scaling& scaling = model_->input_scaling;
  for (int i = 0; i < model_->input.statics(); ++i) {
    const double reach = farthest * scaling.deviation[i];
    const int value = model_->input.modelled[i];
    lowest_[value] = static_cast<float>(scaling.mean[i] - reach);
    highest_[value] = static_cast<float>(scaling.mean[i] + reach);
  }
}

void Recogniser::hold_missing(std::span<const float> values) noexcept {
  const int history = history_of(*model_);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    // What is not a number, or no measurement, would stay in the decoder's paths for ever. (A
    // comparison with what is not a number is false.)
    const auto at = static_cast<Eigen::Index>(i);
    const bool there = !missing_[i] && values[i] >= lowest_[at] && values[i] <= highest_[at];
    if (there) values_[i] = values[i];
    if (missing_[i])
      returned_[i] = 0;
    else
      returned_[i] = std::min(returned_[i] + 1, history + 1);
    // One that came back is left out until its differences no longer reach into the gap.
    wanted_[i] = returned_[i] <= history;
  }
}

void Recogniser::note_unseen() noexcept {
  unseen_.clear();
  std::size_t kept = 0;
  for (int i = 0; i < model_->input.statics(); ++i)
    if (kept < current_->kept.size() && current_->kept[kept] == i)
      ++kept;
    else
      unseen_.push_back(model_->input.modelled[i]);
}

void Recogniser::keep_tables_current() noexcept {
  if (old_to_return_) {
    // The parts let go of the old tables a frame ago: the worker frees them.
    maker_.take(tables_);
    old_to_return_ = awaiting_ = false;
  } else if (maker_.finished()) {
    if (auto fresh = maker_.ready()) {
      current_ = std::move(fresh);
      emissions_.use(current_);
      decoder_.use(current_);
      styles_.use(current_);
      note_unseen();
    }
    old_to_return_ = true;
  }
  if (wanted_ != masked_ && maker_.ask(wanted_)) {
    awaiting_ = true;
    for (std::size_t i = 0; i < wanted_.size(); ++i) masked_[i] = wanted_[i];
  }
}

bool Recogniser::advance(std::span<const float> values) noexcept {
  hold_missing(values);
  keep_tables_current();
  observer_.advance(values_);
  newest_ = (newest_ + 1) % static_cast<int>(ring_.size());
  ++taken_;
  Held& frame = ring_[newest_];
  frame.scaled = observer_.scaled();
  frame.unclipped = observer_.unclipped();
  frame.clipped = observer_.clipped();
  frame.raw = observer_.raw();
  frame.known = observer_.known();
  decoder_.advance(emissions_.of(frame.scaled, frame.known));
  frame.squared_distances = emissions_.squared_distances();
  frame.seen = emissions_.seen();
  if (!decoder_.decided()) return false;
  decide(decoder_.lag(), decoder_.state(), decoder_.weighted(), decoder_.progress());
  return true;
}

bool Recogniser::flush() noexcept {
  if (decided_ >= taken_) return false;
  const int back = taken_ - 1 - decided_;
  const WeightedState state{decoder_.state_at_end(back), 1};
  decide(back, state.state, {&state, 1}, decoder_.progress_at_end(back));
  return true;
}

void Recogniser::decide(int back, int state, std::span<const WeightedState> states,
                        float progress) noexcept {
  decided_back_ = back;
  ++decided_;
  const Held& frame = held(back);
  state_count_ = static_cast<int>(states.size());
  std::copy(states.begin(), states.end(), states_.begin());
  styles_.advance(states, frame.scaled, frame.known);
  decision_.label = current_->states[state].label;
  decision_.state = state - current_->first_state[decision_.label];
  decision_.log_likelihood = decoder_.log_likelihood();
  decision_.progress = progress;
  note_distances(frame);
  follow_phase();
}

void Recogniser::note_distances(const Held& frame) noexcept {
  if (frame.clipped) unclipped_.take(*current_, frame.unclipped);
  decision_.distance = 0;
  for (int i = 0; i < state_count_; ++i) {
    const int state = states_[i].state;
    distances_[i] =
        frame.clipped ? unclipped_.distance(current_->states[state], frame.seen)
                      : std::sqrt(frame.squared_distances[state] / static_cast<float>(frame.seen));
    decision_.distance += states_[i].weight * distances_[i];
  }
}

// The phase that the decided states see in the observation.
PhaseEstimate Recogniser::phase_seen() noexcept {
  constexpr float farthest = 0.15f;  // cycles from a state's own phase: what it saw in training
  if (current_->states.front().phase_gain.size() == 0)
    return phase_.of(states(), decision_.progress);
  const bool late = !whitened();
  if (late) late_whitening_.take(*current_, scaled());
  const int count = current_->depths[current_->depth_of(known(), model_->input)];
  for (int i = 0; i < state_count_; ++i) {
    const PlayedState& state = current_->states[states_[i].state];
    const auto e = late ? late_whitening_.innovation(state, count) : innovation(states_[i].state);
    seen_phases_[i] = state.phase + std::clamp(state.phase_gain.head(count).dot(e.head(count)),
                                               -farthest, farthest);
  }
  return phase_.of(states(), decision_.progress, seen_phases_);
}

void Recogniser::follow_phase() noexcept {
  estimate_ = phase_seen();
  decision_.phase = estimate_.phase;
  decision_.cadence = phase_.cycle(decision_.label).cadence();
  if (!cyclic_) return;
  clock_.advance(1 / model_->frame_rate);
  clock_.observe(estimate_.seen, estimate_.certainty, estimate_.age);
  decision_.phase = clock_.phase();
  decision_.cadence = clock_.cadence();
}

}  // namespace gait
