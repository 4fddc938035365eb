#include "gait/play/body/body_stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gait/model/body_pose.h"
#include "gait/motion/rotation.h"

namespace gait {

namespace {

// Within this time a body comes to a stop, or starts.
constexpr float stopping_seconds = 0.2f;
// Within this time after a whole pose the root stops being gentle, as feet are locked no longer.
constexpr float unlocking_seconds = 0.7f;

}  // namespace

BodyStage::BodyStage(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      hips_(body_roles(required_body(*model_)).hips),
      period_(static_cast<float>(1 / model_->frame_rate)),
      assembly_(model_),
      roots_(Eigen::VectorXf::Zero(4)),
      filter_(model_->body->skeleton.size()),
      motion_(model_->body->skeleton, body_roles(*model_->body), model_->frame_rate),
      foot_lock_(model_->body->skeleton, body_roles(*model_->body), model_->frame_rate),
      meter_(*model_) {
  const Body& body = *model_->body;
  const JointRoles roles = body_roles(body);
  model_leg_ = std::max(1e-3f, static_cast<float>(leg_length(body.skeleton, roles)));
  for (const Leg& leg : {roles.right, roles.left})
    for (const int joint : {leg.thigh, leg.shank, leg.foot})
      leg_joints_.push_back(static_cast<std::size_t>(joint));
  references_ = float_references(body);
  for (const Joint& joint : body.skeleton.joints) {
    offsets_.push_back(joint.offset.cast<float>());
    parents_.push_back(joint.parent);
  }
  above_.assign(parents_.size(), false);
  for (int joint = parents_[hips_]; joint >= 0; joint = parents_[joint]) above_[joint] = true;
  for (int joint = 0; joint < body.skeleton.size(); ++joint)
    if (joint != hips_ && parents_[joint] < 0) above_[joint] = true;
  for (int joint = 0; joint < body.skeleton.size(); ++joint)
    if (joint != hips_ && !above_[joint]) bones_.push_back({parents_[joint], joint});
  for (int joint = 0; joint < body.skeleton.size(); ++joint)
    for (const Eigen::Vector3d& tip : body.skeleton.joints[joint].tips) {
      if (above_[joint]) continue;
      bones_.push_back({joint, body.skeleton.size() + static_cast<int>(tips_.size())});
      tips_.push_back({static_cast<std::size_t>(joint), tip.cast<float>()});
    }
  pose_ = references_;
  world_.resize(pose_.size());
  values_ = assembly_.values();
  positions_.assign(3 * (pose_.size() + tips_.size()), 0.0f);
}

bool BodyStage::store_inputs(std::span<const float> values) noexcept {
  return assembly_.store_inputs(values);
}

bool BodyStage::store_pose(std::span<const float> values) noexcept {
  return assembly_.store_pose(values);
}

bool BodyStage::store_root(const RootPlace& root) noexcept {
  if (!root.hips.allFinite() || !std::isfinite(root.heading)) return false;
  const std::array<float, 4> values{root.hips.x(), root.hips.y(), root.hips.z(), root.heading};
  roots_.store(values);
  return true;
}

bool BodyStage::show_outputs(std::span<const float> values) noexcept {
  if (!assembly_.take_outputs(values)) return false;
  make();
  return true;
}

bool BodyStage::show_pose(std::span<const float> values) noexcept {
  if (!assembly_.take_pose(values)) return false;
  make();
  return true;
}

bool BodyStage::set_heading_rate(float radians_per_second) noexcept {
  if (!std::isfinite(radians_per_second)) return false;
  heading_rate_ = std::clamp(radians_per_second, -10.0f, 10.0f);
  return true;
}

bool BodyStage::set_heading(float radians) noexcept {
  if (!std::isfinite(radians)) return false;
  heading_ = radians;
  return true;
}

bool BodyStage::set_place(const Eigen::Vector3f& place) noexcept {
  if (!place.allFinite()) return false;
  place_ = place;
  return true;
}

bool BodyStage::set_smooth(float hertz) noexcept {
  if (!std::isfinite(hertz) || hertz < 0) return false;
  filter_.set_cutoff(hertz);
  return true;
}

bool BodyStage::set_leg_length(float metres) noexcept {
  if (!std::isfinite(metres) || metres < 0) return false;
  scale_ = metres > 0 ? std::clamp(metres / model_leg_, 0.01f, 100.0f) : 1.0f;
  return true;
}

std::span<const float> BodyStage::pose() const noexcept {
  return {values_.data(), static_cast<std::size_t>(values_.size())};
}

void BodyStage::reset() noexcept {
  begin_anew();
  roots_.reset();
  heading_ = 0;
  path_.setZero();
}

void BodyStage::begin_anew() noexcept {
  assembly_.reset();
  filter_.reset();
  motion_.reset();
  foot_lock_.reset();
  lock_awake_ = false;
  meter_.reset();
  started_ = false;
  gentle_ = 0;
  feet_ = {};
}

void BodyStage::make() noexcept {
  roots_.mark();
  wake_foot_lock();
  values_ = assembly_.values();
  pose_from<float>(pose(), references_, pose_);
  if (filter_.on()) {
    filter_.apply(pose_, period_);
    pose_vector<float>(pose_, references_, {values_.data(), 3 * pose_.size()});
  }
  if (watched_) meter_.advance(pose_);
  move();
  hold_feet();
  if (!watched_) return;
  watch_feet();
  place_joints();
}

void BodyStage::move() noexcept {
  if (started_)
    going_.advance(glide_share(period_, stopping_seconds));
  else
    going_.arrive();
  heading_ = std::remainder(heading_ + going_.value() * heading_rate_ * period_,
                            2 * std::numbers::pi_v<float>);
  const Eigen::Vector3f before = walked_;
  gentle_ = assembly_.whole() ? 1 : std::max(0.0f, gentle_ - period_ / unlocking_seconds);
  motion_.set_gentle(may_lock() ? gentle_ : 0);
  walked_ = motion_.advance(pose_, heading_);
  if (started_ && from_ == RootFrom::feet) {
    const Eigen::Vector3f moved = going_.value() * (walked_ - before);
    path_.x() += moved.x(), path_.z() += moved.z();
  }
  path_.y() = walked_.y();
  started_ = true;

  if (from_ == RootFrom::keep && roots_.any()) {
    const auto root = roots_.at(assembly_.delay());
    root_.hips = place_ + scale_ * Eigen::Vector3f(root[0], root[1], root[2]);
    root_.heading = root[3];
  } else {
    root_.hips = place_ + scale_ * path_.cast<float>();
    root_.heading = heading_;
  }
}

// The lock compares each frame with the one before: before the first that it holds, it is shown the
// last one that it did not.
void BodyStage::wake_foot_lock() noexcept {
  if (lock_awake_ || !may_lock() || !assembly_.whole()) return;
  lock_awake_ = true;
  if (started_) foot_lock_.apply(pose_, motion_, heading_, 0);
}

// A body that does not walk is not held: nothing says where such feet are to be.
void BodyStage::hold_feet() noexcept {
  if (!lock_awake_) return;
  foot_lock_.apply(pose_, motion_, heading_, may_lock() && assembly_.whole() ? going_.value() : 0);
  if (foot_lock_.corrected())
    for (const std::size_t joint : leg_joints_)
      values_from<float>(pose_[joint], references_[joint], values_.data() + 3 * joint);
  if (may_lock() && assembly_.whole()) return;
  lock_awake_ = motion_.sunk() || !foot_lock_.idle();
  if (!lock_awake_) foot_lock_.reset();
}

void BodyStage::watch_feet() noexcept {
  for (const Foot foot : {Foot::right, Foot::left}) {
    FootState& state = feet_[index(foot)];
    state.stride.reset();
    state.touched = state.touch.advance(motion_.share_of(foot)) && going_.target() > 0;
    if (!state.touched) continue;
    const Eigen::Vector3f along = walked_ - state.place;
    if (state.ever) state.stride = scale_ * std::hypot(along.x(), along.z());
    state.place = walked_;
    state.ever = true;
  }
}

void BodyStage::place_joints() noexcept {
  for (std::size_t joint = 0; joint < pose_.size(); ++joint) {
    Placement<float>& placed = world_[joint];
    if (above_[joint])  // rigs put empty roots above the hips: on the ground below them
      placed = {Eigen::Quaternionf::Identity(), {root_.hips.x(), place_.y(), root_.hips.z()}};
    else if (static_cast<int>(joint) == hips_)
      placed = {about_vertical(root_.heading) * pose_[joint], root_.hips};
    else
      placed = placed_under(world_[parents_[joint]], pose_[joint], offsets_[joint], scale_);
    std::copy_n(placed.place.data(), 3, positions_.data() + 3 * joint);
  }
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    const Placement<float>& joint = world_[tips_[i].joint];
    const Eigen::Vector3f place = joint.place + scale_ * (joint.rotation * tips_[i].offset);
    std::copy_n(place.data(), 3, positions_.data() + 3 * (pose_.size() + i));
  }
}

bool BodyStage::same_bones(const BodyStage& other) const noexcept {
  return period_ == other.period_ && parents_ == other.parents_ && offsets_ == other.offsets_ &&
         leg_joints_ == other.leg_joints_ &&
         std::ranges::equal(tips_, other.tips_, {}, &Tip::offset, &Tip::offset);
}

bool BodyStage::take_over(const BodyStage& other) noexcept {
  if (positions_.size() != other.positions_.size() ||
      model_->input.values != other.model_->input.values ||
      model_->output.values != other.model_->output.values)
    return false;
  set_delay(other.assembly_.delay());
  from_ = other.from_;
  lock_ = other.lock_;
  going_ = other.going_;
  heading_rate_ = other.heading_rate_;
  place_ = other.place_;
  scale_ = other.scale_ * other.model_leg_ / model_leg_;
  filter_.set_cutoff(other.filter_.cutoff());
  // Its path goes on from where it is; the pose begins anew in another body.
  heading_ = other.heading_;
  path_ = other.path_ * (other.scale_ / scale_);
  if (!same_bones(other)) return true;
  started_ = other.started_;
  motion_ = other.motion_, foot_lock_ = other.foot_lock_, lock_awake_ = other.lock_awake_;
  walked_ = other.walked_, gentle_ = other.gentle_;
  return true;
}

}  // namespace gait
