#include "gait/play/synthesise/synthesiser.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gait/model/label_cycle.h"
#include "gait/motion/finite.h"
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

}  // namespace

Synthesiser::Synthesiser(const PlayModel& played, const SynthesiserSettings& settings)
    : model_(played.model),
      trajectory_(*model_, queue_frames(settings.past, model_->play.past, model_->frame_rate),
                  settings.current,
                  queue_frames(settings.future, model_->play.future, model_->frame_rate)),
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
  if (settings.walks_alone) walker_.emplace(played);
  const LabelCycle cycle = label_cycles(*model_).front();
  labels_in_cycle_ = static_cast<float>(cycle.labels);
  cadence_ = cycle.cadence();
  if (walker_) std::ranges::copy(walker_->inputs(), means_.data());
  means_.tail(model_->output.values) = model_->output_mean.cast<float>();
  shown_ = walked_ = fed_ = {means_, means_};
}

void Synthesiser::Moving::take(const Eigen::VectorXf& values) noexcept {
  now.swap(before);
  now = values;
}

void Synthesiser::reset() noexcept {
  if (walker_) walker_->reset();
  trajectory_.reset();
  hand_over_.stop();
  alone_ = stood_ = jumps_ = false;
  walking_ = true;
  place_ = {};
  returned_ = shown_frames_ = 0;
  for (Moving* moving : {&shown_, &walked_, &fed_}) moving->now = moving->before = means_;
  std::ranges::fill(pose_, 0.0f);
}

void Synthesiser::set_past(int frames) {
  trajectory_.resize(std::clamp(frames, whole_past, longest_past), future());
}

void Synthesiser::set_future(int frames) {
  frames = std::clamp(frames, 0, longest_future);
  if (frames == future()) return;
  trajectory_.resize(past(), frames);
  trajectory_.forget_flushed();
  if (alone_) trajectory_.reset();
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

// The frame that left the trajectory.
void Synthesiser::take_fed() noexcept {
  scratch_.tail(model_->output.values) = trajectory_.values();
  if (shown_frames_ == 0) controls_.arrive();
  controls_.apply(means_, scratch_);
  scratch_.head(inputs_) = shown_.now.head(inputs_);  // held, and bent by the walker already
  fed_.take(scratch_);
}

// Whether the Gaussian may come one frame after what was shown: its mean, against where its own
// first differences lead from there.
bool Synthesiser::follows_shown(std::span<const float> means,
                                std::span<const float> variances) const noexcept {
  const auto values = static_cast<std::size_t>(model_->output.values);
  float sum = 0;
  for (const int value : model_->output.modelled) {
    const auto i = static_cast<std::size_t>(value);
    const float difference = means[i] - means[values + i] - shown_.now[inputs_ + value];
    sum += difference * difference / (variances[i] + variances[values + i]);
  }
  return sum <
         farthest_following * farthest_following * static_cast<float>(model_->output.statics());
}

bool Synthesiser::push(std::span<const float> means, std::span<const float> variances,
                       bool after_gap) noexcept {
  if (!fits(means, variances)) return false;
  if (trajectory_.flushed()) begin_alone();
  if (after_gap && !alone_ && shown_frames_ > 0 && !follows_shown(means, variances)) {
    trajectory_.reset();
    jumps_ = true;
  }
  const bool leaves = trajectory_.push(means, variances);
  stood_ = !walking_;
  move_place();
  if (!leaves) {
    if (!alone_ || shown_frames_ == 0) return false;
    make_alone();
    return alone_as_ != OnLost::stop;
  }
  take_fed();
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
  return fall_in_step(*walker_, place_.phase, place_.cadence);
}

// What was said since the last frame speaks of this one.
void Synthesiser::move_place() noexcept {
  if (std::exchange(place_.just_said, false)) return;
  place_.phase += place_.cadence * period_ / labels_in_cycle_;
  place_.phase -= std::floor(place_.phase);
}

bool Synthesiser::go_on() noexcept {
  if (!alone_) {
    if (shown_frames_ > 0 && flush()) return true;
    begin_alone();
  } else if (alone_as_ != wanted()) {
    begin_alone();
  }
  if (walker_) walker_->set_pace(1);
  // Frames that came and stopped again are not the same motion as those that come next.
  trajectory_.reset();
  returned_ = 0;
  if (alone_as_ == OnLost::stop || (alone_as_ == OnLost::hold && shown_frames_ == 0)) return false;
  make_alone();
  return true;
}

bool Synthesiser::flush() noexcept {
  if (alone_ || !trajectory_.flush()) return false;
  take_fed();
  show(fed_);
  return true;
}

OnLost Synthesiser::wanted() const noexcept {
  return on_lost_ == OnLost::walk && (stood_ || !walker_) ? OnLost::hold : on_lost_;
}

void Synthesiser::begin_alone() noexcept {
  alone_ = true;
  jumps_ = false;
  alone_as_ = wanted();
  returned_ = 0;
  trajectory_.reset();
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
    StepPlace place = walker_->place_at(0, place_.phase, -period_ * place_.cadence);
    place.cadence = place_.cadence;
    walker_->enter(place, weights_);
    place_.known = place_.fresh = false;
  } else {
    walker_->advance();
  }
  take_walked();
  walker_->advance();
  take_walked();
}

void Synthesiser::take_walked() noexcept {
  std::ranges::copy(walker_->inputs(), scratch_.data());
  std::ranges::copy(walker_->outputs(), scratch_.data() + inputs_);
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
    walker_->advance();
    take_walked();
  }
  show(walked_);
}

void Synthesiser::show(const Moving& motion) noexcept {
  controls_.advance(cadence_ * period_);
  if (walker_ && &motion == &fed_) walker_->streams().advance(cadence_ * period_);  // it sleeps
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
  return controls_.set_scale(stream, scale) &&
         (!walker_ || walker_->streams().set_scale(stream, scale));
}
bool Synthesiser::set_shift(int stream, std::span<const float> by) noexcept {
  return controls_.set_shift(stream, by) && (!walker_ || walker_->streams().set_shift(stream, by));
}
bool Synthesiser::fix(int stream, std::span<const float> at) noexcept {
  return controls_.fix(stream, at) && (!walker_ || walker_->streams().fix(stream, at));
}
bool Synthesiser::free(int stream) noexcept {
  return controls_.free(stream) && (!walker_ || walker_->streams().free(stream));
}

bool Synthesiser::take_over(const Synthesiser& other) {
  if (inputs_ != other.inputs_ || shown_.now.size() != other.shown_.now.size() ||
      pose_.size() != other.pose_.size() || weights_.size() != other.weights_.size() ||
      walker_.has_value() != other.walker_.has_value() ||
      (walker_ && !walker_->take_over(*other.walker_)))
    return false;
  if (model_->output.modelled == other.model_->output.modelled) {
    trajectory_ = other.trajectory_;
  } else {
    trajectory_.resize(other.past(), other.future());
    trajectory_.reset();
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
