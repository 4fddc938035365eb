#include "gait/play/clips/clip_player.h"

#include <algorithm>
#include <cmath>

namespace gait {

namespace {

constexpr double hair = 1e-3;  // of a frame: closer moments are the same

// A moment between two frames.
struct Between {
  int before = 0, after = 0;
  double share = 0;
};

Between between(const BodyMotion& motion, double time) {
  const double at = std::clamp(time * motion.frame_rate, 0.0, motion.frames() - 1.0);
  const double nearest = std::round(at);
  if (std::abs(at - nearest) < hair) {
    const int frame = static_cast<int>(nearest);
    return {frame, frame, 0};
  }
  const int before = static_cast<int>(at);
  return {before, before + 1, at - before};
}

Eigen::Vector3d turned(const Eigen::Vector3d& place, double angle) {
  return about_vertical(angle) * place;
}

}  // namespace

ClipPlayer::ClipPlayer(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      references_(float_references(required_body(*model_))),
      rotations_(references_),
      inputs_(3 * model_->body->input_joints.size()),
      pose_(3 * references_.size()) {
  frame_.inputs = inputs_;
  frame_.pose = pose_;
}

bool ClipPlayer::set_motion(std::shared_ptr<const BodyMotion> motion) noexcept {
  if (motion && (motion->frames() == 0 || motion->joints != model_->body->skeleton.size()))
    return false;
  motion_ = std::move(motion);
  go_to(0);
  return true;
}

void ClipPlayer::set_loop(bool on) noexcept {
  wanted_loop_ = {};
  looping_ = on;
}

void ClipPlayer::set_loop(double begin, double end) noexcept {
  wanted_loop_ = {begin, end};
  looping_ = true;
}

ClipPlayer::Range ClipPlayer::loop() const noexcept {
  const Range range{std::max(0.0, wanted_loop_.begin),
                    std::min(motion_->length(), wanted_loop_.end)};
  if ((range.end - range.begin) * motion_->frame_rate < 1 - hair) return {0, motion_->length()};
  return range;
}

double ClipPlayer::last() const noexcept { return (motion_->frames() - 1) / motion_->frame_rate; }

void ClipPlayer::go_to(double seconds) noexcept {
  time_ = motion_ ? std::clamp(seconds, 0.0, last()) : 0.0;
  begun_ = false;
  path_ = {};
}

std::string_view ClipPlayer::label() const noexcept {
  if (!motion_ || frame_.label < 0) return {};
  return motion_->labels[static_cast<std::size_t>(frame_.label)].label;
}

bool ClipPlayer::advance() noexcept {
  if (!motion_) return false;
  if (begun_) {
    if (!move(speed_ / model_->frame_rate)) return false;
  } else {
    frame_.right = frame_.left = false;
    note_contacts(time_, time_, true);
    begun_ = true;
  }
  make_frame();
  return true;
}

bool ClipPlayer::move(double step) noexcept {
  const double tolerance = hair / motion_->frame_rate;
  double target = time_ + step;
  if (!looping_) {
    if (target > last() + tolerance || target < -tolerance) return false;
    frame_.right = frame_.left = false;
    note_contacts(time_, target, false);
    time_ = target;
    return true;
  }
  frame_.right = frame_.left = false;
  const auto [begin, end] = loop();
  bool landed = false;  // on the loop's other end, whose contact counts as well
  // Outside the loop and leaving it, or past its end: back in at the other side.
  if (step > 0) {
    while (target > end - tolerance) {
      if (time_ < end) note_contacts(time_, end - 2 * tolerance, landed);
      target = time_ < end ? begin + std::max(0.0, target - end) : begin;
      jump(std::max(time_, end), begin);
      time_ = begin;
      landed = true;
    }
  } else if (step < 0) {
    while (target < begin - tolerance) {
      if (time_ > begin) note_contacts(time_, begin, landed);
      target = time_ >= begin - tolerance ? end - (begin - target) : end + step;
      jump(std::min(time_, begin), end);
      time_ = end;
      landed = false;  // the end itself is not in the loop
    }
  }
  note_contacts(time_, target, landed);
  time_ = target;
  return true;
}

// The path goes on: what is at `to` in the walk lies where the walk had come at `from`.
void ClipPlayer::jump(double from, double to) noexcept {
  const Place now = place_in_world(from);
  const Place then = place_in_walk(to);
  path_.heading = now.heading - then.heading;
  path_.hips = now.hips - turned(then.hips, path_.heading);
  path_.hips.y() = 0;  // height belongs to the pose
}

void ClipPlayer::note_contacts(double from, double to, bool with_from) noexcept {
  const double rate = motion_->frame_rate;
  double least = from * rate + (with_from ? -hair : hair);
  double most = to * rate + hair;
  if (to < from) least = to * rate - hair, most = from * rate - hair;  // backwards
  auto contact = std::lower_bound(
      motion_->contacts.begin(), motion_->contacts.end(), least,
      [](const Contact& one, double frame) { return static_cast<double>(one.frame) < frame; });
  for (; contact != motion_->contacts.end() && contact->frame < most; ++contact)
    (contact->foot == Foot::right ? frame_.right : frame_.left) = true;
}

// After the last frame, where a loop may still go for less than a frame, straight on.
ClipPlayer::Place ClipPlayer::place_in_walk(double time) const noexcept {
  const auto at = [&](int frame) {
    return Place{motion_->hips[static_cast<std::size_t>(frame)].cast<double>(),
                 motion_->heading[static_cast<std::size_t>(frame)]};
  };
  Between moment = between(*motion_, time);
  if (const double beyond = (time - last()) * motion_->frame_rate;
      beyond > hair && motion_->frames() > 1)
    moment = {motion_->frames() - 2, motion_->frames() - 1, 1 + beyond};
  const Place before = at(moment.before);
  if (moment.share == 0) return before;
  const Place after = at(moment.after);
  return {before.hips + moment.share * (after.hips - before.hips),
          before.heading + moment.share * (after.heading - before.heading)};
}

ClipPlayer::Place ClipPlayer::place_in_world(double time) const noexcept {
  const Place place = place_in_walk(time);
  return {path_.hips + turned(place.hips, path_.heading), path_.heading + place.heading};
}

void ClipPlayer::make_frame() noexcept {
  const Between moment = between(*motion_, time_);
  const auto before = motion_->pose(moment.before), after = motion_->pose(moment.after);
  for (std::size_t joint = 0; joint < rotations_.size(); ++joint)
    rotations_[joint] = moment.share == 0
                            ? before[joint]
                            : slerp(before[joint], after[joint], static_cast<float>(moment.share));
  const Body& body = *model_->body;
  pose_vector<float>(rotations_, references_, body.input_joints, inputs_);
  pose_vector<float>(rotations_, references_, pose_);
  const Place place = place_in_world(time_);
  frame_.time = time_;
  frame_.hips = place.hips.cast<float>();
  frame_.heading = static_cast<float>(place.heading);
  frame_.label = -1;
  const double tolerance = hair / motion_->frame_rate;
  const auto after_now = std::upper_bound(
      motion_->labels.begin(), motion_->labels.end(), time_ + tolerance,
      [](double time, const LabelSegment& segment) { return time < segment.start; });
  if (after_now != motion_->labels.begin() && time_ + tolerance < std::prev(after_now)->end)
    frame_.label = static_cast<int>(std::prev(after_now) - motion_->labels.begin());
}

}  // namespace gait
