#include "gait/play/body/foot_lock.h"

#include <algorithm>
#include <cmath>

#include "gait/motion/rotation.h"
#include "gait/motion/smoothing.h"

namespace gait {
namespace {

// A range in which something is let go little by little.
struct Range {
  float from, to;
};

// Found on walkers that learnt from the built-in corpus and from Bandai-Namco's captures: where
// feet stay and no joint is much faster than without.
constexpr float stroll = 0.9f;              // m/s: faster walkers' feet come and go faster too
constexpr Range height{0.025f, 0.050f};     // m above the ground: the foot has left it
constexpr Range speed{0.12f, 0.45f};        // m/s over the ground: it moves off
constexpr Range landing_speed{0.4f, 1.2f};  // m/s: a foot that comes down may still be faster
constexpr Range coming_down{-0.2f, 0.0f};   // m/s upward
constexpr double fading_seconds = 0.2;      // of a correction that is not held
constexpr double release_seconds = 0.06;    // in which it begins to fade
constexpr float deepest = 0.007f;           // m that a foot sinks into the ground
constexpr float limp = 0.04f;               // rad: a knee nearer to straight is bent gently
constexpr float quick = 6.0f;               // rad/s: any knee may be turned so fast
constexpr float nothing = 1e-5f;            // m: a correction has faded
constexpr float same_bend = 1e-5f;          // rad: less is rounding
constexpr float out_of_line = 0.1f;         // rad: less bent, a knee's axis is that of the hips too

// 1 up to where the range begins, 0 from its end on.
float within(float value, const Range& range) noexcept {
  return smoothstep(range.to, range.from, value);
}

// In this measure of a knee's angle the squared distance from hip to ankle is linear.
float chord(float angle) noexcept { return 2 * (1 - std::cos(angle)); }
// Back to the angle, but less for knees about as straight as `limp`: where a millimetre less of
// distance bends them by whole degrees.
float gentle_angle(float chord) noexcept {
  constexpr float straight = limp * limp * limp * limp;
  const float squared = chord * chord;
  return 2 * std::asin(std::min(1.0f, std::sqrt(chord) / 2)) * squared / (squared + straight);
}

}  // namespace

FootLock::FootLock(const Skeleton& skeleton, const JointRoles& roles, double frame_rate)
    : hips_(roles.hips),
      joints_(skeleton.joints.size()),
      period_(static_cast<float>(1 / frame_rate)),
      fading_gain_(first_order_gain(1 / frame_rate, fading_seconds)),
      release_gain_(first_order_gain(1 / frame_rate, release_seconds)),
      legs_{chain(skeleton, roles.right, roles.hips), chain(skeleton, roles.left, roles.hips)} {}

FootLock::LegChain FootLock::chain(const Skeleton& skeleton, const Leg& leg, int hips) {
  LegChain chain;
  for (int joint = leg.foot; joint >= 0 && joint != hips; joint = skeleton.joints[joint].parent) {
    Link link;
    link.joint = joint;
    link.offset = skeleton.joints[joint].offset.cast<float>();
    chain.links.insert(chain.links.begin(), link);
  }
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    if (chain.links[i].joint == leg.thigh) chain.thigh = i;
    if (chain.links[i].joint == leg.shank) chain.shank = i;
  }
  return chain;
}

void FootLock::reset() noexcept {
  for (LegChain& leg : legs_) {
    leg.correction.setZero();
    leg.change.setZero();
    leg.hold = leg.lift = 0;
    leg.known = leg.corrected = false;
  }
}

bool FootLock::idle() const noexcept {
  return std::ranges::all_of(legs_, [](const LegChain& leg) {
    return leg.correction.isZero(0) && leg.change.isZero(0) &&
           std::abs(leg.shown_bend - leg.own_bend) <= same_bend;
  });
}

bool FootLock::usable(std::span<const Eigen::Quaternionf> pose) const noexcept {
  if (pose.size() != joints_ || !pose[hips_].coeffs().allFinite()) return false;
  for (const LegChain& leg : legs_)
    for (const Link& link : leg.links)
      if (!pose[link.joint].coeffs().allFinite()) return false;
  return true;
}

void FootLock::apply(std::span<Eigen::Quaternionf> pose, const RootMotion& root, float heading,
                     float strength) noexcept {
  if (!usable(pose) || !std::isfinite(heading)) return;
  const Eigen::Quaternionf hips = about_vertical(heading) * pose[hips_];
  const Eigen::Vector3f velocity = root.velocity();
  const float haste = std::max(1.0f, std::hypot(velocity.x(), velocity.z()) / stroll);
  for (const Foot foot : {Foot::right, Foot::left}) {
    LegChain& leg = legs_[index(foot)];
    const RootMotion::Sole sole = root.sole(foot);
    hold(leg, sole, haste, strength);
    leg.lift = root.sunk() ? std::max(0.0f, -sole.height - deepest) : 0;
    leg.clearance = std::max(0.0f, sole.height + leg.lift + deepest);
    place(leg, pose, hips);
  }
  const LegChain &right = legs_[index(Foot::right)], &left = legs_[index(Foot::left)];
  const Eigen::Vector3f leftward =
      (left.links[left.thigh].world.place - right.links[right.thigh].world.place).normalized();
  for (LegChain& leg : legs_) reach(leg, pose, hips, leftward);
}

// How fast the foot is counts against the pins: a root that is smoother than they are moves a foot
// that stands.
void FootLock::hold(LegChain& leg, const RootMotion::Sole& sole, float haste,
                    float strength) const noexcept {
  const float landing = within(sole.moved.y() / period_, coming_down);
  const Range slow{speed.from + landing * (landing_speed.from - speed.from),
                   speed.to + landing * (landing_speed.to - speed.to)};
  leg.hold = strength * within(sole.height, height) *
             within(std::hypot(sole.pinned.x(), sole.pinned.z()) / (period_ * haste), slow) *
             within(leg.correction.norm(), {near, farthest});
  const Eigen::Vector3f slipped(sole.moved.x(), 0, sole.moved.z());
  const Eigen::Vector3f wanted =
      -leg.hold * slipped - (1 - leg.hold) * fading_gain_ * leg.correction;
  // Held, it follows at once; let go, its speed changes no more than a leg's in swing.
  leg.change += (leg.hold + (1 - leg.hold) * release_gain_) * (wanted - leg.change);
  leg.correction += leg.change;
  const float length = leg.correction.norm();
  if (length > farthest) leg.correction *= farthest / length;
  if (leg.hold == 0 && length + leg.change.norm() < nothing) {
    leg.correction.setZero();
    leg.change.setZero();
  }
}

void FootLock::place(LegChain& leg, std::span<const Eigen::Quaternionf> pose,
                     const Eigen::Quaternionf& hips) noexcept {
  Placement<float> above{hips, Eigen::Vector3f::Zero()};
  for (Link& link : leg.links)
    above = link.world = placed_under(above, pose[link.joint], link.offset);
}

void FootLock::reach(LegChain& leg, std::span<Eigen::Quaternionf> pose,
                     const Eigen::Quaternionf& hips, const Eigen::Vector3f& leftward) noexcept {
  const Eigen::Vector3f correction = leg.correction + leg.lift * Eigen::Vector3f::UnitY();
  leg.corrected = false;
  const Link &thigh = leg.links[leg.thigh], &shank = leg.links[leg.shank], &foot = leg.links.back();
  const Eigen::Vector3f upper = shank.world.place - thigh.world.place,
                        lower = foot.world.place - shank.world.place,
                        ankle = foot.world.place - thigh.world.place;
  const float squared = ankle.squaredNorm(), bones = upper.norm() * lower.norm();
  if (!(squared > 0 && bones > 0)) return;

  // The knee turns about the normal of thigh and shank, where they are in line across the hips.
  const Eigen::Vector3f normal = upper.cross(lower) / bones;
  Eigen::Vector3f axis = out_of_line * (leftward - ankle * (leftward.dot(ankle) / squared));
  if (normal.dot(leftward) > 0) axis += normal;
  axis.normalize();

  // Turned by any angle about that axis, |upper + lower|² = constant + 2 longest cos(bend).
  const float along = upper.dot(axis) * lower.dot(axis);
  const float cosine = upper.dot(lower) - along, sine = upper.dot(axis.cross(lower));
  const float longest = std::hypot(cosine, sine);
  const float bend = -std::atan2(sine, cosine);  // above 0: the way knees bend
  if (!(longest > 0)) return;
  const float now = bend > 0 ? chord(bend) : 0, least = std::min(now, chord(straightest));

  Eigen::Vector3f target = ankle + correction;
  // Farther than the leg reaches: up until it does.
  const float down =
      squared + longest * (now - least) - target.x() * target.x() - target.z() * target.z();
  target.y() = std::max(target.y(), -std::sqrt(std::max(down, 0.0f)));
  const float wanted =
      std::clamp(now + (squared - target.squaredNorm()) / longest, least, chord(3.0f));

  const auto bent = [&](float to) { return bend + gentle_angle(to) - gentle_angle(now); };
  float shown = bent(wanted);
  if (leg.known) {
    // As fast as the knee goes by itself, or as any does; unless that drove the foot into the
    // ground.
    const float most = std::max(std::abs(bend - leg.own_bend), quick * period_);
    const float reached = target.norm() + leg.clearance,
                looser = (reached * reached - target.squaredNorm()) / longest;
    shown = std::max(std::clamp(shown, leg.shown_bend - most, leg.shown_bend + most),
                     std::min(shown, bent(std::max(least, wanted - looser))));
  }
  leg.own_bend = bend, leg.shown_bend = shown;
  leg.known = true;
  leg.corrected = !correction.isZero(0) || std::abs(shown - bend) > same_bend;
  if (!leg.corrected) return;

  const Eigen::Quaternionf at_knee(Eigen::AngleAxisf(shown - bend, axis));
  const Eigen::Quaternionf at_hip =
      turn_between((upper + at_knee * lower).cast<double>(), target.cast<double>()).cast<float>();
  const auto above = [&](std::size_t i) { return i > 0 ? leg.links[i - 1].world.rotation : hips; };
  const Eigen::Quaternionf above_foot = at_hip * at_knee * above(leg.links.size() - 1);
  pose[thigh.joint] = (above(leg.thigh).conjugate() * at_hip * thigh.world.rotation).normalized();
  pose[shank.joint] = (above(leg.shank).conjugate() * at_knee * shank.world.rotation).normalized();
  pose[foot.joint] = (above_foot.conjugate() * foot.world.rotation).normalized();
}

}  // namespace gait
