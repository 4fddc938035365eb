#include "gait/play/continuation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gait/model/body_pose.h"
#include "gait/play/falling_in_step.h"

namespace gait {
namespace {

constexpr double gentle_seconds = 0.7;  // after a hand-over

}  // namespace

Continuation::Continuation(std::shared_ptr<const Model> model, const PlayerSettings& settings,
                           const StepWalkerSettings& walking)
    : reconstructor_(model, settings),
      walker_(model, walking),
      root_(model->body->skeleton, body_roles(*model->body), model->frame_rate),
      hand_over_(3 * model->body->skeleton.size() + 1 + model->output.values, model->frame_rate,
                 hand_over_seconds),
      settling_(std::max(2, model->input.lags.empty() ? 0 : model->input.lags.back())),
      patience_(settling_ +
                static_cast<int>(std::lround(step_patience_seconds * model->frame_rate))),
      period_(1 / model->frame_rate),
      styles_(model->styles.size(), 0.0f) {
  for (const auto& reference : model->body->references)
    references_.push_back(reference.cast<float>());
  const Motion rest{references_, 0, model->output_mean.cast<float>()};
  shown_ = source_ = fed_ = {rest, rest};
  offset_ = Eigen::VectorXf::Zero(3 * model->body->skeleton.size() + 1 + model->output.values);
  offset_before_ = offset_;
}

void Continuation::Moving::take(std::span<const Eigen::Quaternionf> pose, float heading,
                                std::span<const float> outputs) noexcept {
  std::swap(now, before);
  std::ranges::copy(pose, now.pose.begin());
  now.heading = heading;
  std::ranges::copy(outputs, now.outputs.begin());
}

void Continuation::reset(const Eigen::Vector3f& place) noexcept {
  reconstructor_.reset();
  walker_.reset();
  root_.reset(place);
  hand_over_.stop();
  alone_ = false;
  returned_ = shown_frames_ = 0;
}

FrameClock::Arrival Continuation::push(double time,
                                       std::span<const Eigen::Quaternionf> inputs) noexcept {
  const FrameClock::Arrival arrival = reconstructor_.push(time, inputs);
  // Time jumped and nobody had said that poses were missing: the reconstruction begins anew.
  if (arrival == FrameClock::Arrival::restarted && !alone_ && shown_frames_ > 0) begin_alone();
  return arrival;
}

bool Continuation::next() noexcept {
  if (!reconstructor_.next()) return false;
  const ReconstructedFrame& made = reconstructor_.frame();
  if (alone_ && shown_frames_ > 0) {
    if (returned_++ < settling_ || !fall_in_step()) {
      fed_.take(made.pose, made.heading, made.outputs);
      make_alone(made.time);
      return true;
    }
    hand_over_to(fed_);
  }
  alone_ = false;
  make_fed();
  return true;
}

// Legs that go over in mid-step to legs at another phase would drag the feet along.
bool Continuation::fall_in_step() noexcept {
  if (alone_as_ != OnLost::walk || returned_ > patience_) return true;
  const Decision& theirs = reconstructor_.frame().decision;
  return gait::fall_in_step(walker_, theirs.phase, theirs.cadence);
}

bool Continuation::go_on() noexcept {
  if (!alone_) {
    if (reconstructor_.flush()) {
      make_fed();
      return true;
    }
    begin_alone();
  } else if (alone_as_ != on_lost_) {
    begin_alone();
  }
  walker_.set_pace(1);
  // Poses that came and stopped again are not the same motion as those that come next.
  if (returned_ > 0 || reconstructor_.flush()) reconstructor_.reset();
  returned_ = 0;
  if (alone_as_ == OnLost::stop || (alone_as_ == OnLost::hold && shown_frames_ == 0)) return false;
  make_alone(frame_.time + period_);
  return true;
}

void Continuation::begin_alone() noexcept {
  alone_ = true;
  alone_as_ = on_lost_;
  returned_ = 0;
  if (shown_frames_ == 0) return;
  if (alone_as_ == OnLost::walk) {
    walk_from_shown();
  } else {  // the new motion is to rest where the old one was
    source_.take(shown_.now.pose, shown_.now.heading, {shown_.now.outputs.data(), outputs()});
    source_.before = source_.now;
  }
  hand_over_to(source_);
}

// The walker one frame before the last one shown, then there: two frames, so a speed.
void Continuation::walk_from_shown() noexcept {
  const Decision& decision = frame_.decision;
  const float back = static_cast<float>(period_) * decision.cadence;
  StepPlace place = walker_.place_at(decision.label, decision.phase, -back);
  place.cadence = decision.cadence;
  walker_.enter(place, styles_);
  source_.take(walker_.pose(), shown_.now.heading, walker_.outputs());
  walker_.advance();
  source_.take(walker_.pose(), shown_.now.heading, walker_.outputs());
}

void Continuation::hand_over_to(const Moving& motion) noexcept {
  difference(shown_.now, motion.now, offset_);
  difference(shown_frames_ > 1 ? shown_.before : shown_.now, motion.before, offset_before_);
  // A reconstruction that has just begun trembles: its speed over one frame would carry further off
  // than going without.
  if (shown_frames_ == 1 || &motion == &fed_) offset_before_ = offset_;
  hand_over_.begin(offset_, offset_before_);
}

void Continuation::difference(const Motion& shown, const Motion& motion,
                              Eigen::VectorXf& offset) const noexcept {
  const auto joints = static_cast<Eigen::Index>(shown.pose.size());
  for (Eigen::Index joint = 0; joint < joints; ++joint) {
    const auto at = static_cast<std::size_t>(joint);
    offset.segment<3>(3 * joint) =
        rotation_vector<float>(motion.pose[at].conjugate() * shown.pose[at]);
  }
  offset[3 * joints] =
      std::remainder(shown.heading - motion.heading, 2 * std::numbers::pi_v<float>);
  offset.tail(shown.outputs.size()) = shown.outputs - motion.outputs;
}

void Continuation::make_alone(double time) noexcept {
  frame_.time = time;
  if (alone_as_ != OnLost::walk) {
    frame_.decision.cadence = 0;
    show(source_.now);
    return;
  }
  walker_.advance();
  source_.take(walker_.pose(), shown_.now.heading, walker_.outputs());
  frame_.decision = {};
  frame_.decision.label = walker_.label();
  frame_.decision.state = walker_.state();
  frame_.decision.progress = walker_.progress();
  frame_.decision.phase = walker_.phase();
  frame_.decision.cadence = walker_.cadence();
  for (std::size_t style = 0; style < styles_.size(); ++style)
    styles_[style] = walker_.weights()[static_cast<Eigen::Index>(style)];
  show(source_.now);
}

void Continuation::make_fed() noexcept {
  const ReconstructedFrame& made = reconstructor_.frame();
  frame_.time = made.time;
  frame_.decision = made.decision;
  std::ranges::copy(made.styles, styles_.begin());
  source_.take(made.pose, made.heading, made.outputs);
  show(source_.now);
}

void Continuation::show(const Motion& motion) noexcept {
  shown_.take(motion.pose, motion.heading, {motion.outputs.data(), outputs()});
  ++shown_frames_;
  Motion& shown = shown_.now;
  // The feet of a mixture have no place of their own: the root goes by them gently, and takes its
  // time to be where they say.
  if (!hand_over_.over() || (alone_ && alone_as_ == OnLost::walk))
    gentle_ = gentle_seconds;
  else
    gentle_ = std::max(0.0, gentle_ - period_);
  root_.set_gentle(gentle_ > 0);
  if (!hand_over_.over()) {
    const Eigen::VectorXf& offset = hand_over_.advance();
    const auto joints = static_cast<Eigen::Index>(shown.pose.size());
    for (Eigen::Index joint = 0; joint < joints; ++joint)
      shown.pose[static_cast<std::size_t>(joint)] *=
          exponential_map<float>(Vector3<float>(offset.segment<3>(3 * joint)));
    shown.heading += offset[3 * joints];
    shown.outputs += offset.tail(shown.outputs.size());
    show_outputs();
  }
  frame_.styles = styles_;
  frame_.outputs = {shown.outputs.data(), outputs()};
  frame_.pose = shown.pose;
  frame_.heading = shown.heading;
  frame_.hips = root_.advance(shown.pose, shown.heading);
}

// Rotation streams say what the pose is; what is faded linearly are the plain ones.
void Continuation::show_outputs() noexcept {
  const Model& model = reconstructor_.model();
  Motion& shown = shown_.now;
  auto joint = model.body->output_joints.begin();
  Eigen::Index begin = 0;
  for (const Stream& stream : model.outputs) {
    if (stream.kind == StreamKind::rotation) {
      const auto at = static_cast<std::size_t>(*joint++);
      shown.outputs.segment<3>(begin) =
          rotation_vector<float>(references_[at].conjugate() * shown.pose[at]);
    }
    begin += stream.size;
  }
}

bool Continuation::take_over(const Continuation& other) noexcept {
  if (shown_.now.pose.size() != other.shown_.now.pose.size() || period_ != other.period_ ||
      !walker_.take_over(other.walker_))
    return false;
  root_ = other.root_;
  shown_ = other.shown_, source_ = other.source_;
  shown_frames_ = other.shown_frames_;
  styles_ = other.styles_;
  frame_ = other.frame_;
  frame_.styles = styles_;
  frame_.outputs = {shown_.now.outputs.data(), outputs()};
  frame_.pose = shown_.now.pose;
  on_lost_ = other.on_lost_;
  hand_over_ = other.hand_over_;
  reconstructor_.reset();
  returned_ = 0;
  alone_ = other.alone_, alone_as_ = other.alone_as_;
  if (!alone_ && shown_frames_ > 0) begin_alone();
  return true;
}

}  // namespace gait
