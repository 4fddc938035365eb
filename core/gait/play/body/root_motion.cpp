#include "gait/play/body/root_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "gait/error.h"
#include "gait/motion/rotation.h"
#include "gait/motion/smoothing.h"

namespace gait {
namespace {

// Found on captured walks of CMU and Bandai-Namco at 30, 60 and 120 fps, forward and backward,
// where they keep path, slide and hand-overs in balance.
constexpr float softness = 0.06f;             // m/s: points that differ by less share the pin
constexpr float cost_of_height = 4.0f;        // m/s per metre above the lowest point
constexpr float cost_of_disagreement = 0.5f;  // per m/s against the root's motion so far
constexpr float height_scale = 0.015f;        // m: how sharply height alone tells the direction
constexpr float walking_at_all = 0.1f;        // m/s: slower travel has no direction to speak of
constexpr float strongest_push = 27.0f;  // m/s²: hips in walks stay under 20, captured toes do not
constexpr double speed_seconds = 0.015;
constexpr double travel_seconds = 0.5;
constexpr double height_seconds = 0.1 / 3;  // 95 % of a height error is gone after 100 ms
constexpr double deepest_pin = 0.008;       // m: no pinned point sinks further
constexpr double deepest_freely = 0.0088;   // m: nor any point under the root that follows
constexpr double give = 0.005;              // m: deeper than that the ground pushes it out by half
constexpr double deep_still = 0.007;        // m: less is no longer sunk
constexpr double deepest_gently = 0.05;     // m: where legs bend instead
constexpr float fastest_start = 3.0f;       // m/s, above the 10 km/h that walkers reach
constexpr float starting_seconds = 0.3f;    // until pins are believed enough to be smoothed
constexpr float brisk = 1.4f;               // m/s
constexpr double recovery_seconds = 0.2;    // what the root is behind its pins is made up for in
constexpr double gentle_recovery_seconds = 0.5;
constexpr double gentle_lag_seconds = 0.05;  // in speed, where legs take it up
constexpr double same_point = 0.005;         // m

// How hard the root is pushed after its pins: m/s², and more per metre that it is behind. Captured
// hips of clean walks reach 14 m/s² in one frame of a thousand, the built-in ones' 6.
struct Push {
  float least, per_metre;
};
constexpr Push push_alone{12.0f, 400.0f}, push_gently{3.0f, 50.0f}, lift_gently{5.0f, 200.0f};

Eigen::Vector3f horizontal(const Eigen::Vector3f& v) noexcept { return {v.x(), 0, v.z()}; }

}  // namespace

RootMotion::RootMotion(const Skeleton& skeleton, const JointRoles& roles, double frame_rate)
    : joints_(skeleton.size()) {
  if (!std::isfinite(frame_rate) || frame_rate <= 0)
    throw Error("root motion: expected a positive frame rate, found " + std::to_string(frame_rate));
  if (!roles.has_legs())
    throw Error(
        "root motion: expected hips and thigh, shank and foot of both legs; "
        "some of these roles have no joint");
  for (const Leg* leg : {&roles.right, &roles.left})
    if (!skeleton.is_in_branch(leg->foot, roles.hips))
      throw Error("root motion: expected joint '" + skeleton.joints[leg->foot].name +
                  "' below the hips '" + skeleton.joints[roles.hips].name + "'");
  period_ = static_cast<float>(1 / frame_rate);
  speed_gain_ = first_order_gain(1 / frame_rate, speed_seconds);
  travel_gain_ = first_order_gain(1 / frame_rate, travel_seconds);
  height_gain_ = first_order_gain(1 / frame_rate, height_seconds);
  recovery_gain_ = first_order_gain(1 / frame_rate, recovery_seconds);
  gentle_gain_ = first_order_gain(1 / frame_rate, gentle_lag_seconds);
  gentle_recovery_gain_ = first_order_gain(1 / frame_rate, gentle_recovery_seconds);
  add_points(skeleton, roles.hips, roles.right.foot, Foot::right);
  add_points(skeleton, roles.hips, roles.left.foot, Foot::left);
  reset();
}

int RootMotion::add_link(const Skeleton& skeleton, int joint, int hips) {
  for (std::size_t i = 0; i < links_.size(); ++i)
    if (links_[i].joint == joint) return static_cast<int>(i);
  const int parent = joint == hips ? -1 : add_link(skeleton, skeleton.joints[joint].parent, hips);
  Link link;
  link.joint = joint;
  link.parent = parent;
  link.offset = skeleton.joints[joint].offset.cast<float>();
  links_.push_back(link);
  return static_cast<int>(links_.size()) - 1;
}

void RootMotion::add_points(const Skeleton& skeleton, int hips, int foot_joint, Foot foot) {
  const auto add = [&](int joint, const Eigen::Vector3d& offset) {
    Point point;
    point.foot = foot;
    point.link = add_link(skeleton, joint, hips);
    point.offset = offset.cast<float>();
    points_.push_back(point);
  };
  for (int joint = foot_joint; joint < skeleton.size(); ++joint) {
    if (!skeleton.is_in_branch(joint, foot_joint)) continue;
    if (joint == foot_joint || skeleton.joints[joint].offset.norm() > same_point)
      add(joint, Eigen::Vector3d::Zero());
    for (const Eigen::Vector3d& tip : skeleton.joints[joint].tips)
      if (tip.norm() > same_point) add(joint, tip);
  }
}

void RootMotion::reset(const Eigen::Vector3f& place) noexcept {
  frames_ = 0;
  position_ = pinned_ = place.cast<double>();
  velocity_.setZero();
  pinned_velocity_.setZero();
  moved_.setZero();
  pinned_moved_.setZero();
  travel_.setZero();
  walking_ = 0;
  sunk_ = false;
  for (Point& point : points_) {
    point.place.setZero();
    point.before.setZero();
    point.smoothed.setZero();
    point.weight = 0;
  }
}

Eigen::Vector3f RootMotion::advance(std::span<const Eigen::Quaternionf> pose,
                                    float heading) noexcept {
  if (!place_points(pose, heading)) {
    for (Point& point : points_) point.before = point.place;
    moved_.setZero();
    pinned_moved_.setZero();
    return position();
  }
  if (frames_++ == 0) {
    for (Point& point : points_) point.before = point.place;
    position_.y() = pinned_.y() = -lowest_;
    return position();
  }
  update_speeds();
  update_travel();
  weigh_points();
  const Eigen::Vector3d before = position_, pinned_before = pinned_;
  move();
  pinned_moved_ = (pinned_ - pinned_before).cast<float>();
  follow();
  moved_ = (position_ - before).cast<float>();
  return position();
}

// False, with nothing changed that counts, when the pose is not one.
bool RootMotion::place_points(std::span<const Eigen::Quaternionf> pose, float heading) noexcept {
  if (pose.size() != static_cast<std::size_t>(joints_) || !std::isfinite(heading)) return false;
  for (const Link& link : links_)
    if (!pose[link.joint].coeffs().allFinite()) return false;

  for (Link& link : links_) {
    if (link.parent < 0)
      link.world.rotation = about_vertical(heading) * pose[link.joint];
    else
      link.world = placed_under(links_[link.parent].world, pose[link.joint], link.offset);
  }
  lowest_ = std::numeric_limits<float>::max();
  for (Point& point : points_) {
    point.before = point.place;
    const Placement<float>& above = links_[point.link].world;
    point.place = above.place + above.rotation * point.offset;
    lowest_ = std::min(lowest_, point.place.y());
  }
  return true;
}

void RootMotion::update_speeds() noexcept {
  const float share = std::max(speed_gain_, 1 / static_cast<float>(frames_ - 1));
  for (Point& point : points_) {
    point.speed = (point.place - point.before) / period_;
    point.smoothed += share * (point.speed - point.smoothed);
  }
}

// Where the walk goes by height alone: too coarse for the path, but it knows forward from backward.
void RootMotion::update_travel() noexcept {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float weights = 0;
  for (const Point& point : points_) {
    const float weight = std::exp((lowest_ - point.place.y()) / height_scale);
    sum -= weight * horizontal(point.speed);
    weights += weight;
  }
  const float share = std::max(travel_gain_, 1 / static_cast<float>(frames_ - 1));
  travel_ += share * (sum / weights - travel_);
}

void RootMotion::weigh_points() noexcept {
  const float squared = travel_.squaredNorm();
  walking_ = squared / (squared + walking_at_all * walking_at_all);
  // Towards the travel, of length walking_.
  const Eigen::Vector3f direction = travel_ * (walking_ / std::max(travel_.norm(), 1e-6f));
  float best = std::numeric_limits<float>::lowest();
  for (Point& point : points_) {
    point.weight_before = point.weight;
    // The weight holds the score until the best one is known.
    point.weight = -point.smoothed.dot(direction) - cost_of_height * (point.place.y() - lowest_) -
                   cost_of_disagreement * horizontal(point.smoothed + pinned_velocity_).norm();
    best = std::max(best, point.weight);
  }
  float sum = 0;
  for (Point& point : points_) {
    point.weight = std::exp((point.weight - best) / softness);
    sum += point.weight;
  }
  for (Point& point : points_) point.weight /= sum;
}

void RootMotion::move() noexcept {
  // A walking body is pinned by this frame's weights, a standing one by their mean with the last
  // frame's: otherwise a weight that trembles with its own point would pump the root along.
  const float of_last = frames_ > 2 ? 0.5f * (1 - walking_) : 0;
  Eigen::Vector3f wanted = Eigen::Vector3f::Zero();
  for (const Point& point : points_)
    wanted -= (point.weight + of_last * (point.weight_before - point.weight)) * point.speed;
  Eigen::Vector3f change = wanted - pinned_velocity_;
  // The first speed along the ground comes from nowhere: there is nothing to be gentle with.
  const bool first = frames_ == 2;
  const float limit = first ? fastest_start : strongest_push * period_;
  const float along = horizontal(change).norm();
  if (along > limit) change.x() *= limit / along, change.z() *= limit / along;
  change.y() = std::clamp(change.y(), -strongest_push * period_, strongest_push * period_);
  pinned_velocity_ += change;
  pinned_ += (pinned_velocity_ * period_).cast<double>();
  pinned_.y() -= height_gain_ * (pinned_.y() + lowest_);
  pinned_.y() = std::max(pinned_.y(), -static_cast<double>(lowest_) - deepest_pin);
}

bool RootMotion::starting() const noexcept {
  return static_cast<float>(frames_ - 1) * period_ <= starting_seconds;
}

void RootMotion::follow() noexcept {
  if (starting()) {
    position_ = pinned_;
    velocity_ = pinned_moved_ / period_;
    return;
  }
  const Eigen::Vector3f behind = (pinned_ - position_).cast<float>() - pinned_moved_;
  const auto mixed = [this](float alone, float gently) {
    return alone + gentle_ * (gently - alone);
  };
  const float recovery = mixed(recovery_gain_, gentle_recovery_gain_);
  Eigen::Vector3f change = (pinned_moved_ + recovery * behind) / period_ - velocity_;
  change *= mixed(1, gentle_gain_);
  // Hips are thrown the harder the faster the walk, by the square of its speed.
  const float pace = std::max(1.0f, travel_.squaredNorm() / (brisk * brisk));
  const auto limit = [&](const Push& gently, float distance) {
    const float push = mixed(push_alone.least, pace * gently.least) +
                       mixed(push_alone.per_metre, gently.per_metre) * distance;
    return std::min(push, strongest_push) * period_;
  };
  const float along = horizontal(change).norm(),
              most = limit(push_gently, horizontal(behind).norm());
  if (along > most) change.x() *= most / along, change.z() *= most / along;
  const float upward = limit(lift_gently, std::abs(behind.y()));
  change.y() = std::clamp(change.y(), -upward, upward);
  velocity_ += change;
  position_ += (velocity_ * period_).cast<double>();
  stay_above_ground();
}

void RootMotion::stay_above_ground() noexcept {
  const double low = -static_cast<double>(lowest_) - position_.y();
  sunk_ = gentle_ > 0 || (sunk_ && low > deep_still);
  if (gentle_ < 1 && low > give)
    position_.y() += (1 - gentle_) * (sunk_ ? 0.1 : 0.5) * (low - give);
  position_.y() = std::max(
      position_.y(), -static_cast<double>(lowest_) - (sunk_ ? deepest_gently : deepest_freely));
}

float RootMotion::share_of(Foot foot) const noexcept {
  float share = 0;
  for (const Point& point : points_)
    if (point.foot == foot) share += point.weight;
  return share;
}

RootMotion::Sole RootMotion::sole(Foot foot) const noexcept {
  Sole sole;
  sole.height = std::numeric_limits<float>::max();
  for (const Point& point : points_) {
    const float height = static_cast<float>(position_.y()) + point.place.y();
    if (point.foot != foot || height >= sole.height) continue;
    const Eigen::Vector3f moved = point.place - point.before;
    sole = {height, moved_ + moved, pinned_moved_ + moved};
  }
  return sole;
}

}  // namespace gait
