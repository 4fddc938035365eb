#include "gait/play/synthesise/step_walker.h"

#include <algorithm>
#include <cmath>

#include "gait/model/body_pose.h"
#include "gait/model/label_cycle.h"

namespace gait {

namespace {

constexpr double lookahead_seconds = 0.2;
// Of the whole past, what a walk that begins anew is led up to by.
constexpr double led_up_seconds = 2.0 / 3;
// However a performer walked, the walk that goes on is one that the model knows.
constexpr float slowest_tempo = 2, fastest_tempo = 0.5f;

Eigen::VectorXf neutral_weights(const Model& model, const StepTables& tables) {
  Eigen::VectorXf weights(tables.styles);
  for (int i = 0; i < tables.styles; ++i) weights[i] = tables.can_walk[i] ? 1.0f : 0.0f;
  for (std::size_t i = 0; i < model.styles.size(); ++i)
    if ((model.styles[i] == "neutral" || model.styles[i] == "normal") && tables.can_walk[i])
      return Eigen::VectorXf::Unit(tables.styles, static_cast<Eigen::Index>(i));
  return weights / weights.sum();
}

}  // namespace

StepWalker::StepWalker(const PlayModel& played, const StepWalkerSettings& settings)
    : model_(played.model),
      tables_(played.steps()),
      period_(static_cast<float>(1 / model_->frame_rate)),
      queue_(tables_->successors),
      durations_(tables_->durations),
      mix_(tables_->can_walk, neutral_weights(*model_, *tables_)),
      layout_(StreamLayout::of_all(*model_)),
      controls_(layout_),
      trajectory_(tables_->values,
                  queue_frames(settings.past, model_->play.past, model_->frame_rate), 1,
                  queue_frames(settings.future, lookahead_seconds, model_->frame_rate)),
      past_(trajectory_.past() == whole_past ? queue_frames(led_up_seconds, model_->frame_rate)
                                             : trajectory_.past()),
      places_(static_cast<std::size_t>(trajectory_.delay()) + 1),
      gaussian_(tables_, period_),
      given_(Eigen::VectorXf::Zero(tables_->styles)),
      values_(tables_->mean),
      means_(tables_->mean) {
  if (model_->body) pose_ = references_ = float_references(*model_->body);
  for (const LabelCycle& cycle : label_cycles(*model_)) {
    phase_begin_.push_back(cycle.begin());
    phase_span_.push_back(1 / static_cast<float>(cycle.labels));
  }
}

bool StepWalker::set_weights(std::span<const float> weights) noexcept {
  return !model_->styles.empty() && mix_.set(weights);
}

bool StepWalker::set_style(int style) noexcept {
  return !model_->styles.empty() && mix_.set_only(style);
}

void StepWalker::reset() noexcept {
  started_ = false;
  pace_ = 1;
  queue_.clear();
  durations_.set_tempo(1);
  ahead_ = {};
  std::ranges::fill(places_, Place{});
  entered_.reset();
  values_ = tables_->mean;
}

void StepWalker::begin() noexcept {
  started_ = true;
  mix_.arrive();
  controls_.arrive();
  durations_.arrive(mix_.weights());
  const int first = queue_.take(LabelQueue::none);
  if (first != LabelQueue::none) {
    ahead_ = {first, queue_.before(first), 0, false};
  } else {  // stands where the first label would begin
    const int before = queue_.before(0);
    ahead_ = {before == LabelQueue::none ? 0 : before, LabelQueue::none, 1, true};
  }
  fill();
  if (first != LabelQueue::none) entered_ = first;
}

void StepWalker::enter(const StepPlace& place, std::span<const float> weights) noexcept {
  started_ = true;
  pace_ = 1;
  if (weights.size() == tables_->can_walk.size() && !model_->styles.empty()) {
    for (std::size_t i = 0; i < weights.size(); ++i)
      given_[static_cast<Eigen::Index>(i)] = tables_->can_walk[i] ? weights[i] : 0.0f;
    mix_.set({given_.data(), weights.size()});
  }
  mix_.arrive();
  durations_.set_tempo(1);
  durations_.arrive(mix_.weights());
  if (place.cadence > 0) {
    durations_.set_tempo(
        std::clamp(1 / (place.cadence * durations_.model_mean()), fastest_tempo, slowest_tempo));
    durations_.arrive(mix_.weights());
  }
  const int label = std::clamp(place.label, 0, tables_->labels() - 1);
  ahead_ = {label, queue_.before(label), std::clamp(place.progress, 0.0f, 0.9999f), false};
  fill();
}

StepPlace StepWalker::place_at(int label, float phase, float labels) const noexcept {
  label = std::clamp(label, 0, tables_->labels() - 1);
  phase += labels * phase_span_[label];
  phase -= std::floor(phase);
  StepPlace place{label, 0, 0};
  // The labels of a cycle lead back to the first.
  for (int i = 0; i < tables_->labels(); ++i) {
    place.progress = (phase - phase_begin_[place.label]) / phase_span_[place.label];
    if (place.progress >= 0 && place.progress < 1) return place;
    const auto& successors = tables_->successors[place.label];
    if (successors.empty() || successors.front() == label) break;
    place.label = successors.front();
  }
  place.progress = std::clamp(place.progress, 0.0f, 1.0f);
  return place;
}

// The queue of states as if it had always walked like this: past_ frames up to the place ahead_
// says, which is the one to be shown, and then the future.
void StepWalker::fill() noexcept {
  trajectory_.reset();
  const Place start = ahead_;
  for (int i = past_; i > 0; --i)
    push(start.standing ? start : back(start, static_cast<float>(i) * period_));
  push(start);
  newest_ = 0;
  places_[0] = start;
  for (std::size_t i = 1; i < places_.size(); ++i) {
    move();
    push(ahead_);
    places_[i] = ahead_;
  }
  entered_.reset();
  show();
}

StepWalker::Place StepWalker::back(Place place, float seconds) const noexcept {
  while (true) {
    const float elapsed = place.progress * durations_.of(place.label);
    if (seconds <= elapsed) {
      place.progress -= seconds / durations_.of(place.label);
      return place;
    }
    if (place.before == LabelQueue::none) {
      place.progress = 0;
      return place;
    }
    seconds -= elapsed;
    place = {place.before, queue_.before(place.before), 1, false};
  }
}

// One frame on.
void StepWalker::move() noexcept {
  float seconds = pace_ * period_;
  while (true) {
    const float duration = durations_.of(ahead_.label);
    const float left = (1 - ahead_.progress) * duration;
    if (seconds < left) {
      ahead_.progress += seconds / duration;
      ahead_.standing = false;
      return;
    }
    const int next = queue_.take(ahead_.label);
    if (next == LabelQueue::none) {
      ahead_.progress = 1;
      ahead_.standing = true;
      return;
    }
    seconds -= left;
    ahead_ = {next, ahead_.label, 0, false};
  }
}

void StepWalker::push(const Place& place) noexcept {
  const float duration = durations_.of(place.label) / pace_;
  trajectory_.push(gaussian_.at({place.label, place.before, queue_.peek(place.label),
                                 place.progress, place.standing ? 0.0f : duration},
                                mix_.weights()));
}

void StepWalker::advance() noexcept {
  if (!started_) {
    begin();
    return;
  }
  const int label_before = shown().label;
  const float labels = period_ / durations_.of(ahead_.label);
  const int in_cycle = static_cast<int>(std::lround(1 / phase_span_[ahead_.label]));
  mix_.advance(labels / static_cast<float>(std::max(2, in_cycle)));
  durations_.advance(labels, mix_.weights());
  controls_.advance(labels);
  move();
  push(ahead_);
  places_[static_cast<std::size_t>(newest_)] = ahead_;
  newest_ = (newest_ + 1) % static_cast<int>(places_.size());
  entered_.reset();
  if (shown().label != label_before) entered_ = shown().label;
  show();
}

void StepWalker::show() noexcept {
  const auto path = trajectory_.generate();
  values_ = means_ = tables_->mean;
  for (std::size_t i = 0; i < tables_->modelled.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    values_[tables_->modelled[i]] = path(at, 0);
    means_[tables_->modelled[i]] = tables_->style_means.row(at).dot(mix_.weights());
  }
  controls_.apply(means_, values_);
  const std::span<const float> values(values_.data(), static_cast<std::size_t>(values_.size()));
  for (const StreamPlace& place : layout_)
    if (place.joint >= 0)
      pose_[place.joint] =
          rotation_from<float>(values.subspan(place.begin).first<3>(), references_[place.joint]);
}

std::span<const float> StepWalker::inputs() const noexcept {
  return {values_.data(), static_cast<std::size_t>(model_->input.values)};
}

std::span<const float> StepWalker::outputs() const noexcept {
  return {values_.data() + model_->input.values, static_cast<std::size_t>(model_->output.values)};
}

int StepWalker::state() const noexcept {
  const int first = tables_->first_state[shown().label];
  int state = first;
  while (state + 1 < tables_->first_state[shown().label + 1] &&
         tables_->states[static_cast<std::size_t>(state) + 1].begin <= progress())
    ++state;
  return state - first;
}

void StepWalker::set_pace(float pace) noexcept {
  if (std::isfinite(pace)) pace_ = std::clamp(pace, 0.1f, 4.0f);
}

float StepWalker::behind(float phase, float cadence) const noexcept {
  const float ahead =
      cadence * phase_span_[ahead_.label] * period_ * static_cast<float>(places_.size() - 1);
  float cycles = phase + ahead - phase_of(ahead_);
  cycles -= std::floor(cycles);
  return cycles > 0.4f ? cycles - 1 : cycles;
}

float StepWalker::phase_of(const Place& place) const noexcept {
  const float phase = phase_begin_[place.label] + place.progress * phase_span_[place.label];
  return phase < 1 ? phase : phase - 1;
}

float StepWalker::cadence() const noexcept {
  return shown().standing ? 0.0f : pace_ / durations_.of(shown().label);
}

bool StepWalker::take_over(const StepWalker& other) noexcept {
  if (!tables_->same_sizes(*other.tables_) || period_ != other.period_) return false;
  queue_ = other.queue_;
  durations_.take_over(other.durations_);
  mix_ = other.mix_;
  controls_.take_over(other.controls_);
  started_ = other.started_;
  pace_ = other.pace_;
  values_ = other.values_, pose_ = other.pose_;
  entered_ = other.entered_;
  if (!started_) return true;
  if (trajectory_.past() == other.trajectory_.past() && places_.size() == other.places_.size()) {
    trajectory_ = other.trajectory_;
    ahead_ = other.ahead_;
    places_ = other.places_;
    newest_ = other.newest_;
  } else {  // another queue: as if these states had always filled it
    ahead_ = other.shown();
    fill();
  }
  return true;
}

}  // namespace gait
