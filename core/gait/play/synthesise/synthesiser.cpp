#include "gait/play/synthesise/synthesiser.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gait/model/label_cycle.h"
#include "gait/play/synthesise/falling_in_step.h"

namespace gait {

namespace {

// Deviations per value. Frames that follow each other stay under 1.1 in the built-in walks.
constexpr float farthest_following = 1.2f;

std::vector<int> pose_positions(const Model& model) {
  std::vector<int> positions;
  for (const StreamPlace& place : StreamLayout::of_all(model))
    for (int i = 0; i < place.size; ++i)
      positions.push_back(!model.body        ? place.begin + i
                          : place.joint >= 0 ? 3 * place.joint + i
                                             : -1);
  return positions;
}

bool all_finite(std::span<const float> values) noexcept {
  return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

}  // namespace

Synthesiser::Synthesiser(const PlayModel& played, const SynthesiserSettings& settings)
    : model_(played.model),
      walker_(played),
      trajectory_(model_->output.statics(), 0, 1, 0),
      controls_(StreamLayout::of_all(*model_)),
      hand_over_(StreamLayout::of_all(*model_), model_->frame_rate),
      period_(static_cast<float>(1 / model_->frame_rate)),
      inputs_(model_->input.values),
      settling_(std::max(2, model_->input.lags.empty() ? 0 : model_->input.lags.back())),
      patience_(settling_ + queue_frames(step_patience_seconds, model_->frame_rate)),
      positions_(pose_positions(*model_)),
      weights_(model_->styles.size(), 0.0f),
      means_(Eigen::VectorXf::Zero(inputs_ + model_->output.values)),
      scratch_(means_),
      pose_(model_->body ? static_cast<std::size_t>(3 * model_->body->skeleton.size())
                         : positions_.size(),
            0.0f) {
  resize(settings.past.value_or(queue_frames(model_->play.past, model_->frame_rate)),
         settings.future.value_or(queue_frames(model_->play.future, model_->frame_rate)));
  const LabelCycle cycle = label_cycles(*model_).front();
  labels_in_cycle_ = static_cast<float>(cycle.labels);
  cadence_ = cycle.cadence();
  gaussian_ = {Eigen::VectorXf::Zero(model_->output.size()),
               Eigen::VectorXf::Ones(model_->output.size())};
  std::ranges::copy(walker_.inputs(), means_.data());
  means_.tail(model_->output.values) = model_->output_mean.cast<float>();
  shown_ = walked_ = fed_ = {means_, means_};
}

void Synthesiser::Moving::take(const Eigen::VectorXf& values) noexcept {
  now.swap(before);
  now = values;
}

void Synthesiser::reset() noexcept {
  walker_.reset();
  restart_fed();
  hand_over_.stop();
  alone_ = stood_ = jumps_ = false;
  walking_ = true;
  place_ = {};
  returned_ = shown_frames_ = 0;
  for (Moving* moving : {&shown_, &walked_, &fed_}) moving->now = moving->before = means_;
  std::ranges::fill(pose_, 0.0f);
}

void Synthesiser::restart_fed() noexcept {
  trajectory_.reset();
  flushed_ = 0;
}

void Synthesiser::resize(int past, int future) {
  past = std::clamp(past, 0, longest_past), future = std::clamp(future, 0, longest_future);
  Eigen::MatrixXf statics(model_->output.values, future + 1);
  const int before = static_cast<int>(statics_.cols());
  for (int back = 0; back <= future; ++back) {
    const int column = future - back;
    if (before == 0)
      statics.col(column) = model_->output_mean.cast<float>();
    else
      statics.col(column) = statics_.col((newest_ - std::min(back, before - 1) + before) % before);
  }
  statics_ = std::move(statics);
  newest_ = future;
  trajectory_.resize(past, future);
}

void Synthesiser::set_past(int frames) { resize(frames, future()); }

void Synthesiser::set_future(int frames) {
  frames = std::clamp(frames, 0, longest_future);
  if (frames == future()) return;
  resize(past(), frames);
  // The frames that come next are earlier or later ones than those that would have come.
  flushed_ = 0;
  if (alone_) restart_fed();
  jumps_ = shown_frames_ > 0 && !alone_;
}

bool Synthesiser::fits(std::span<const float> means,
                       std::span<const float> variances) const noexcept {
  const auto values = static_cast<std::size_t>(model_->output.values);
  if (means.size() != 3 * values || variances.size() != 3 * values) return false;
  if (!all_finite(means) || !all_finite(variances)) return false;
  for (std::size_t part = 0; part < 3; ++part)
    for (const int value : model_->output.modelled)
      if (!(variances[part * values + static_cast<std::size_t>(value)] > 0)) return false;
  return true;
}

void Synthesiser::load(std::span<const float> means, std::span<const float> variances) noexcept {
  const Eigen::Index values = model_->output.values, modelled = model_->output.statics();
  for (Eigen::Index part = 0; part < 3; ++part)
    for (Eigen::Index i = 0; i < modelled; ++i) {
      const auto at = static_cast<std::size_t>(
          part * values + model_->output.modelled[static_cast<std::size_t>(i)]);
      gaussian_.mean[part * modelled + i] = means[at];
      gaussian_.variance[part * modelled + i] = variances[at];
    }
  newest_ = (newest_ + 1) % static_cast<int>(statics_.cols());
  statics_.col(newest_) = Eigen::Map<const Eigen::VectorXf>(means.data(), values);
}

// The frame `back` frames ago: what moves as the trajectory has it, the rest as it was told.
void Synthesiser::take_fed(const Eigen::Ref<const Eigen::VectorXf>& modelled, int back) noexcept {
  const int length = static_cast<int>(statics_.cols());
  scratch_.tail(model_->output.values) = statics_.col((newest_ - back + length) % length);
  for (Eigen::Index i = 0; i < modelled.size(); ++i)
    scratch_[inputs_ + model_->output.modelled[static_cast<std::size_t>(i)]] = modelled[i];
  if (shown_frames_ == 0) controls_.arrive();
  controls_.apply(means_, scratch_);
  scratch_.head(inputs_) = shown_.now.head(inputs_);  // held, and bent by the walker already
  fed_.take(scratch_);
}

// Whether the Gaussian may come one frame after what was shown: its mean, against where its own
// first differences lead from there.
bool Synthesiser::follows_shown() const noexcept {
  const Eigen::Index modelled = model_->output.statics();
  float sum = 0;
  for (Eigen::Index i = 0; i < modelled; ++i) {
    const auto at = inputs_ + model_->output.modelled[static_cast<std::size_t>(i)];
    const float difference = gaussian_.mean[i] - gaussian_.mean[modelled + i] - shown_.now[at];
    sum += difference * difference / (gaussian_.variance[i] + gaussian_.variance[modelled + i]);
  }
  return sum < farthest_following * farthest_following * static_cast<float>(modelled);
}

bool Synthesiser::push(std::span<const float> means, std::span<const float> variances,
                       bool after_gap) noexcept {
  if (!fits(means, variances)) return false;
  if (flushed_ > 0) begin_alone();
  load(means, variances);
  if (after_gap && !alone_ && shown_frames_ > 0 && !follows_shown()) {
    trajectory_.reset();
    jumps_ = true;
  }
  trajectory_.push(gaussian_);
  stood_ = !walking_;
  move_place();
  if (!trajectory_.ready()) {
    if (!alone_ || shown_frames_ == 0) return false;
    make_alone();
    return alone_as_ != OnLost::stop;
  }
  take_fed(trajectory_.generate().col(0), future());
  if (alone_ && shown_frames_ > 0) {
    if (returned_++ < settling_ || !in_step()) {
      make_alone();
      return alone_as_ != OnLost::stop;
    }
    // A reconstruction that has just begun trembles: its speed over one frame would carry further
    // off than going without.
    hand_over_to(fed_, false);
  } else if (jumps_) {
    hand_over_.begin_before(shown_.now, shown_.before, fed_.now);
  }
  alone_ = jumps_ = false;
  show(fed_);
  return true;
}

bool Synthesiser::in_step() noexcept {
  if (alone_as_ != OnLost::walk || stood_ || !place_.fresh || returned_ > patience_) return true;
  return fall_in_step(walker_, place_.phase, place_.cadence);
}

// What was said since the last frame speaks of this one.
void Synthesiser::move_place() noexcept {
  if (std::exchange(place_.just_said, false)) return;
  place_.phase += place_.cadence * period_ / labels_in_cycle_;
  place_.phase -= std::floor(place_.phase);
}

bool Synthesiser::go_on() noexcept {
  if (!alone_) {
    const int held = std::min(trajectory_.filled(), future()) - flushed_;
    if (held > 0 && shown_frames_ > 0) {
      take_fed(trajectory_.flush(held).col(0), held - 1);
      ++flushed_;
      show(fed_);
      return true;
    }
    begin_alone();
  } else if (alone_as_ != wanted()) {
    begin_alone();
  }
  walker_.set_pace(1);
  // Frames that came and stopped again are not the same motion as those that come next.
  restart_fed();
  returned_ = 0;
  if (alone_as_ == OnLost::stop || (alone_as_ == OnLost::hold && shown_frames_ == 0)) return false;
  make_alone();
  return true;
}

OnLost Synthesiser::wanted() const noexcept {
  return on_lost_ == OnLost::walk && stood_ ? OnLost::hold : on_lost_;
}

void Synthesiser::begin_alone() noexcept {
  alone_ = true;
  jumps_ = false;
  alone_as_ = wanted();
  returned_ = 0;
  restart_fed();
  if (shown_frames_ == 0) return;
  if (alone_as_ == OnLost::walk)
    walk_from_shown();
  else  // the new motion is to rest where the old one was
    walked_ = shown_, walked_.before = walked_.now;
  hand_over_to(walked_, true);
}

// The walker one frame before the last one shown, then there: two frames, so a speed.
void Synthesiser::walk_from_shown() noexcept {
  if (place_.known) {
    StepPlace place = walker_.place_at(0, place_.phase, -period_ * place_.cadence);
    place.cadence = place_.cadence;
    walker_.enter(place, weights_);
    place_.known = place_.fresh = false;
  } else {
    walker_.advance();
  }
  take_walked();
  walker_.advance();
  take_walked();
}

void Synthesiser::take_walked() noexcept {
  std::ranges::copy(walker_.inputs(), scratch_.data());
  std::ranges::copy(walker_.outputs(), scratch_.data() + inputs_);
  walked_.take(scratch_);
}

void Synthesiser::hand_over_to(const Moving& motion, bool speed_known) noexcept {
  if (speed_known && shown_frames_ > 1)
    hand_over_.begin(shown_.now, shown_.before, motion.now, motion.before);
  else
    hand_over_.begin(shown_.now, motion.now);
}

void Synthesiser::make_alone() noexcept {
  if (alone_as_ == OnLost::stop) return;
  if (alone_as_ == OnLost::walk) {
    walker_.advance();
    take_walked();
  }
  show(walked_);
}

void Synthesiser::show(const Moving& motion) noexcept {
  controls_.advance(cadence_ * period_);
  if (&motion == &fed_) walker_.streams().advance(cadence_ * period_);  // it sleeps
  shown_.take(motion.now);
  shown_frames_ = std::min(shown_frames_ + 1, 2);
  hand_over_.apply(shown_.now);
  for (std::size_t i = 0; i < positions_.size(); ++i)
    if (positions_[i] >= 0)
      pose_[static_cast<std::size_t>(positions_[i])] = shown_.now[static_cast<Eigen::Index>(i)];
}

bool Synthesiser::walks() const noexcept {
  return alone_ && alone_as_ == OnLost::walk && shown_frames_ > 0;
}

std::span<const float> Synthesiser::outputs() const noexcept {
  return {shown_.now.data() + inputs_, static_cast<std::size_t>(model_->output.values)};
}

bool Synthesiser::set_place(float phase, float cadence, std::span<const float> weights) noexcept {
  if (!std::isfinite(phase) || !std::isfinite(cadence) || weights.size() != weights_.size() ||
      !all_finite(weights))
    return false;
  place_ = {true, true, true, phase - std::floor(phase), std::clamp(cadence, 0.0f, 10.0f)};
  std::ranges::copy(weights, weights_.begin());
  return true;
}

void Synthesiser::set_walking(bool walking) noexcept {
  walking_ = walking;
  if (walking) stood_ = false;
}

bool Synthesiser::set_scale(int stream, float scale) noexcept {
  return controls_.set_scale(stream, scale) && walker_.streams().set_scale(stream, scale);
}
bool Synthesiser::set_shift(int stream, std::span<const float> by) noexcept {
  return controls_.set_shift(stream, by) && walker_.streams().set_shift(stream, by);
}
bool Synthesiser::fix(int stream, std::span<const float> at) noexcept {
  return controls_.fix(stream, at) && walker_.streams().fix(stream, at);
}
bool Synthesiser::free(int stream) noexcept {
  return controls_.free(stream) && walker_.streams().free(stream);
}

bool Synthesiser::take_over(const Synthesiser& other) {
  if (inputs_ != other.inputs_ || shown_.now.size() != other.shown_.now.size() ||
      pose_.size() != other.pose_.size() || weights_.size() != other.weights_.size() ||
      !walker_.take_over(other.walker_))
    return false;
  if (past() != other.past() || future() != other.future()) resize(other.past(), other.future());
  if (model_->output.modelled == other.model_->output.modelled) {
    trajectory_ = other.trajectory_;
    statics_ = other.statics_;
    newest_ = other.newest_, flushed_ = other.flushed_;
  } else {
    restart_fed();
  }
  controls_.take_over(other.controls_);
  hand_over_ = other.hand_over_;
  shown_ = other.shown_, walked_ = other.walked_, fed_ = other.fed_;
  shown_frames_ = other.shown_frames_;
  pose_ = other.pose_;
  on_lost_ = other.on_lost_, alone_as_ = other.alone_as_;
  alone_ = other.alone_, walking_ = other.walking_, stood_ = other.stood_;
  place_ = other.place_;
  weights_ = other.weights_;
  returned_ = other.returned_;
  jumps_ = shown_frames_ > 0 && !alone_;  // another model, another motion
  return true;
}

}  // namespace gait
