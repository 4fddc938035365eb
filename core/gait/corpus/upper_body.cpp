#include "gait/corpus/upper_body.h"

#include <cmath>
#include <numbers>

#include "gait/corpus/variation.h"
#include "gait/motion/rotation.h"

namespace gait {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

double once_a_cycle(double phase) { return std::cos(2 * std::numbers::pi * (phase - mid_stance)); }
double once_a_step(double phase) { return std::cos(4 * std::numbers::pi * (phase - mid_stance)); }

Quaterniond about_x(double angle) { return exponential_map<double>({angle, 0, 0}); }
Quaterniond about_z(double angle) { return exponential_map<double>({0, 0, angle}); }

Quaterniond mirrored(const Quaterniond& q) { return {q.w(), q.x(), -q.y(), -q.z()}; }

}  // namespace

UpperBody::UpperBody(const WalkStyle& style, std::uint64_t seed, const std::string& stream,
                     int first_step, int steps)
    : style_(style),
      trunk_{MeanGaitCurve(MeanJoint::hips, style.speed),
             MeanGaitCurve(MeanJoint::spine, style.speed),
             MeanGaitCurve(MeanJoint::spine1, style.speed),
             MeanGaitCurve(MeanJoint::spine2, style.speed),
             MeanGaitCurve(MeanJoint::neck, style.speed),
             MeanGaitCurve(MeanJoint::head, style.speed)},
      arm_curve_(MeanJoint::left_arm, style.speed),
      forearm_curve_(MeanJoint::left_forearm, style.speed) {
  const auto vary = [&](const std::string& what) {
    return step_variation(Deviates(seed, stream + "/" + what), first_step, steps, 0.5, 0.45);
  };
  lean_ = vary("lean"), roll_ = vary("roll"), turn_ = vary("turn"), slump_ = vary("slump");
  nod_ = vary("nod"), head_turn_ = vary("head turn"), head_roll_ = vary("head roll");
  range_ = vary("trunk range");
  const auto vary_arm = [&](const std::string& side) {
    return Arm{vary(side + " forward"), vary(side + " spread"), vary(side + " twist"),
               vary(side + " elbow"),   vary(side + " range"),  vary(side + " lag")};
  };
  left_ = vary_arm("left"), right_ = vary_arm("right");
}

void UpperBody::pose(double phase, std::span<Quaterniond> rotations) const {
  const WalkStyle& s = style_;
  const double step = 2 * phase, posture = s.variation.posture;
  const double range = 1 + s.variation.range * range_.at(step);
  const double roll = s.trunk_roll * range * once_a_cycle(phase) + 0.6 * posture * roll_.at(step);
  const double bob = s.trunk_bob * range * once_a_step(phase);
  const double slump = s.slump + posture * slump_.at(step);
  const double turned = 0.5 * posture * turn_.at(step);

  std::array<Vector3d, 6> v;
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = trunk_[i].at(phase);

  v[0] = Vector3d(v[0].x() + s.pelvis_tilt, range * s.pelvis_turn * v[0].y(),
                  range * s.pelvis_list * v[0].z());
  for (std::size_t i = 1; i < 4; ++i) {
    v[i].y() = range * s.trunk_turn * v[i].y() + turned / 3;
    v[i].x() += slump / 3 + bob / 3;
    // What the pelvis rolls the lower back undoes, in the mean gait and in every range.
    v[i].z() = range * s.pelvis_list * v[i].z() + roll / 3;
  }
  v[1].x() += s.lean - s.pelvis_tilt + 0.6 * posture * lean_.at(step);
  v[4].x() += s.neck + 0.5 * s.head_bob * once_a_step(phase) + 0.5 * posture * nod_.at(step);
  v[5].x() += s.head + 0.5 * s.head_bob * once_a_step(phase) + 0.5 * posture * nod_.at(step);
  v[5].y() += 1.2 * posture * head_turn_.at(step);
  v[4].z() += 0.5 * s.head_roll * once_a_cycle(phase) + 0.6 * posture * head_roll_.at(step);
  v[5].z() += 0.5 * s.head_roll * once_a_cycle(phase);
  for (std::size_t i = 0; i < v.size(); ++i) rotations[i] = exponential_map(v[i]);

  pose_arm(left_, true, phase, step, rotations.subspan(6, 3));
  pose_arm(right_, false, phase, step, rotations.subspan(9, 3));
}

void UpperBody::pose_arm(const Arm& arm, bool left, double phase, double step,
                         std::span<Quaterniond> shoulder_arm_forearm) const {
  const WalkStyle& s = style_;
  const double posture = s.variation.posture;
  const double own =
      (left ? phase : phase + 0.5) - s.arm_lag - 0.15 * s.variation.range * arm.lag.at(step);
  const double favour = left ? 1 - s.one_sided : 1 + s.one_sided;
  const double range = favour * (1 + s.variation.range * arm.range.at(step));

  const Vector3d mean = arm_curve_.mean();
  const Vector3d swung = mean + s.arm_swing * range * (arm_curve_.at(own) - mean);
  const Quaterniond upper = about_x(-s.arm_forward - posture * arm.forward.at(step)) *
                            about_z(s.arm_spread + 0.7 * posture * arm.spread.at(step)) *
                            exponential_map(swung) *
                            about_x(s.arm_twist + posture * arm.twist.at(step));

  // The mean gait's elbow is a hinge about this axis.
  const Vector3d hinge = Vector3d(0, -0.866, 0.5).normalized();
  const double bent = forearm_curve_.mean().dot(hinge);
  const double wanted = bent + s.elbow_swing * range * (forearm_curve_.at(own).dot(hinge) - bent) +
                        s.elbow_bend + (left ? 0.3 * s.one_sided : 0) +
                        posture * arm.elbow.at(step);
  constexpr double least = 0.08;
  const double elbow = least + 0.5 * (wanted - least + std::hypot(wanted - least, 0.08));

  shoulder_arm_forearm[0] = exponential_map<double>({0, -s.shoulder_forward, s.shoulder_raise});
  shoulder_arm_forearm[1] = upper;
  shoulder_arm_forearm[2] = exponential_map<double>(elbow * hinge);
  if (!left)
    for (Quaterniond& rotation : shoulder_arm_forearm.first(3)) rotation = mirrored(rotation);
}

}  // namespace gait
