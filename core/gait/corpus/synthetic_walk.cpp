#include "gait/corpus/synthetic_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gait/corpus/variation.h"
#include "gait/error.h"
#include "gait/motion/rotation.h"

namespace gait {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// Even, so that a foot's prints begin with a right one.
constexpr int steps_before = 6, steps_after = 6;
constexpr double straightest_knee = 0.13;

enum Bone { thigh_bone, shank_bone, foot_bone };
constexpr int first_bone(Foot foot) { return foot == Foot::left ? 12 : 15; }
constexpr double outward(Foot foot) { return foot == Foot::left ? 1 : -1; }

Foot foot_of(int step) { return step % 2 == 0 ? Foot::right : Foot::left; }

std::string stream_of(const WalkPlan& plan) {
  return plan.style.name + "/" + std::to_string(plan.take);
}

const WalkPlan& checked(const WalkPlan& plan) {
  if (plan.cycles < 1)
    throw Error("a walk needs at least one cycle, not " + std::to_string(plan.cycles));
  if (!(plan.leg_length > 0))
    throw Error("a leg length must be above 0 m, not " + std::to_string(plan.leg_length));
  for (const CadenceChange& change : plan.cadence)
    if (!(change.scale > 0))
      throw Error("a cadence scale must be above 0, not " + std::to_string(change.scale));
  return plan;
}

}  // namespace

SyntheticWalk::SyntheticWalk(const WalkPlan& plan)
    : skeleton_(mean_body(checked(plan).leg_length)),
      style_(scaled(plan.style, plan.leg_length / corpus_leg_length)),
      leg_{-skeleton_.joints[first_bone(Foot::left) + shank_bone].offset.y(),
           -skeleton_.joints[first_bone(Foot::left) + foot_bone].offset.y()},
      sole_{-skeleton_.joints[first_bone(Foot::left) + foot_bone].tips[0].y(),
            skeleton_.joints[first_bone(Foot::left) + foot_bone].tips[0].z(),
            -skeleton_.joints[first_bone(Foot::left) + foot_bone].tips[1].z()},
      first_step_(-steps_before),
      steps_(2 * plan.cycles + 1 + steps_before + steps_after),
      upper_body_(plan.style, plan.seed, stream_of(plan), first_step_, steps_),
      knee_curve_(MeanJoint::left_knee, plan.style.speed) {
  const auto vary = [&](const char* what) {
    return step_variation(Deviates(plan.seed, stream_of(plan) + what), first_step_, steps_, 0.4,
                          0.4);
  };
  pitch_range_ = vary("/foot pitch"), knee_ = vary("/knee"), sway_range_ = vary("/sway");
  constexpr int samples = 20;
  for (int i = 0; i < samples; ++i)
    knee_mean_ += knee_curve_.at(0.5 + 0.5 * (i + 0.5) / samples).x() / samples;
  lay_prints(plan);
  lay_pelvis();
}

void SyntheticWalk::lay_prints(const WalkPlan& plan) {
  const WalkStyle& s = style_;
  const StyleVariation& v = s.variation;
  const auto deviates = [&](const char* what, double persistence) {
    Deviates stream(plan.seed, stream_of(plan) + what);
    return step_deviates(stream, steps_, persistence);
  };
  const auto timing = deviates("/timing", 0.3), length = deviates("/length", 0.3),
             width = deviates("/width", 0.2), wander = deviates("/wander", 0.8),
             toes = deviates("/toes", 0.3), lift = deviates("/lift", 0.3);

  // A leg of another length walks dynamically alike: the same leg lengths a second (G04 §4).
  const double frequency = s.cadence * mean_gait_frequency(s.speed);
  const double step_seconds = 0.5 / frequency;
  const double step_metres = s.speed * plan.leg_length * step_seconds;

  std::array<std::vector<Footprint>, 2> prints;
  std::vector<double> drawn_phase;
  std::vector<double> scales;
  double z = 0, time = 0;
  for (int i = 0; i < steps_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Foot foot = foot_of(i);
    const double side = outward(foot);
    const double half_width = 0.5 * (s.step_width + v.width * width[k]);
    times_.push_back(time);
    drawn_phase.push_back(0.5 * (i + first_step_));
    prints[static_cast<std::size_t>(foot)].push_back(
        {side * half_width + v.wander * wander[k], z,
         side * (s.toe_out + 0.5 * v.posture * toes[k]), time, 1 + v.lift * lift[k]});
    double scale = 1;
    const double since_first = i < steps_before ? -1.0 : time - times_[steps_before];
    for (const CadenceChange& change : plan.cadence)
      if (since_first >= change.seconds) scale = change.scale;
    const double limp = foot == Foot::right ? 1 + s.limp : 1 - s.limp;
    time += step_seconds * limp * (1 + v.timing * timing[k]) / scale;
    z += step_metres * (1 + v.length * length[k]);
  }
  start_ = times_[steps_before] - 0.9 * (times_[steps_before] - times_[steps_before - 1]);
  const std::size_t last = static_cast<std::size_t>(steps_before + 2 * plan.cycles);
  duration_ = times_[last] + 0.5 * (times_[last + 1] - times_[last]) - start_;
  for (std::size_t i = steps_before; i <= last; ++i)
    contacts_.push_back({times_[i] - start_, foot_of(static_cast<int>(i))});
  phase_ = InterpolatingCurve(times_, drawn_phase);
  for (const Foot foot : {Foot::right, Foot::left})
    feet_.emplace_back(s, sole_, outward(foot), std::move(prints[static_cast<std::size_t>(foot)]));
}

double SyntheticWalk::foot_cycles(Foot foot, double drawn_phase) const {
  return drawn_phase - 0.5 * first_step_ - (foot == Foot::left ? 0.5 : 0.0);
}

FootState SyntheticWalk::foot_at(Foot foot, double drawn_phase) const {
  const double range = 1 + 0.5 * style_.variation.lift * pitch_range_.at(2 * drawn_phase);
  return feet_[static_cast<std::size_t>(foot)].at(foot_cycles(foot, drawn_phase), range);
}

Vector3d SyntheticWalk::pelvis_over_ground(double time, double drawn_phase) const {
  const double sway = style_.sway * (1 + style_.variation.range * sway_range_.at(2 * drawn_phase));
  // Fastest while both feet push, slowest over the standing leg.
  constexpr double surge = 0.008;
  return {pelvis_x_.at(time) - sway * std::cos(2 * std::numbers::pi * (drawn_phase - mid_stance)),
          0, pelvis_z_.at(time) + surge * std::sin(4 * std::numbers::pi * (drawn_phase - 0.05))};
}

// The height at which the standing knee bends as the mean gait's, each foot heard by the load it
// bears; `limit` is the height at which a leg is as straight as it may be.
double SyntheticWalk::wanted_height(double time, double drawn_phase, double& limit) const {
  const WalkStyle& s = style_;
  std::array<Quaterniond, 12> upper;
  upper_body_.pose(drawn_phase, upper);
  const Vector3d pelvis = pelvis_over_ground(time, drawn_phase);
  const double both = s.stance - 0.5;
  double height = 0;
  limit = 1e9;
  for (const Foot foot : {Foot::right, Foot::left}) {
    const FootState state = foot_at(foot, drawn_phase);
    const Vector3d hip =
        upper[0] * skeleton_.joints[static_cast<std::size_t>(first_bone(foot))].offset;
    const double dx = pelvis.x() + hip.x() - state.ankle.x();
    const double dz = pelvis.z() + hip.z() - state.ankle.z();
    const auto height_with = [&](double knee) {
      const double reach = leg_.reach(knee);
      return state.ankle.y() + std::sqrt(std::max(reach * reach - dx * dx - dz * dz, 1e-4)) -
             hip.y();
    };
    limit = std::min(limit, height_with(straightest_knee));
    const double cycles = foot_cycles(foot, drawn_phase), phase = cycles - std::floor(cycles);
    const double load = smoother_step(phase / both) - smoother_step((phase - 0.5) / both);
    if (load <= 0) continue;
    const double mean_knee = knee_curve_.at(phase + 0.5).x();
    const double knee = knee_mean_ + s.knee_yield * (mean_knee - knee_mean_) + s.knee_bend +
                        s.variation.knees * knee_.at(2 * drawn_phase);
    height += load * height_with(std::max(knee, straightest_knee));
  }
  return height + s.bounce * std::cos(4 * std::numbers::pi * (drawn_phase - mid_stance));
}

namespace {

// Mean over each place's neighbourhood of `reach` places to both sides.
std::vector<double> box_mean(const std::vector<double>& values, int reach) {
  std::vector<double> sums(values.size() + 1, 0.0), mean(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) sums[i + 1] = sums[i] + values[i];
  const int last = static_cast<int>(values.size()) - 1;
  for (int i = 0; i <= last; ++i) {
    const int from = std::max(0, i - reach), to = std::min(last, i + reach);
    mean[i] = (sums[to + 1] - sums[from]) / (to + 1 - from);
  }
  return mean;
}

std::vector<double> smoothed(std::vector<double> values, int reach) {
  for (int pass = 0; pass < 3; ++pass) values = box_mean(values, reach);
  return values;
}

std::vector<double> largest_near(const std::vector<double>& values, int reach) {
  std::vector<double> largest(values.size());
  const int last = static_cast<int>(values.size()) - 1;
  for (int i = 0; i <= last; ++i)
    largest[i] = *std::max_element(values.begin() + std::max(0, i - reach),
                                   values.begin() + std::min(last, i + reach) + 1);
  return largest;
}

}  // namespace

void SyntheticWalk::lay_pelvis() {
  const Vector3d hips = skeleton_.joints[static_cast<std::size_t>(first_bone(Foot::left))].offset;
  std::vector<double> times, x, z;
  for (int i = 2; i + 2 < steps_; ++i) {
    const double at = 0.5 * (i + first_step_);
    const Vector3d middle = 0.5 * (foot_at(Foot::right, at).ankle + foot_at(Foot::left, at).ankle);
    times.push_back(times_[static_cast<std::size_t>(i)]);
    x.push_back(middle.x());
    z.push_back(middle.z() - hips.z() + style_.pelvis_lead);
  }
  pelvis_x_ = InterpolatingCurve(times, x);
  pelvis_z_ = InterpolatingCurve(times, z);

  constexpr double grid = 1.0 / 240;
  const double from = times_[3];
  const int count = static_cast<int>((times_[static_cast<std::size_t>(steps_) - 4] - from) / grid);
  std::vector<double> height(static_cast<std::size_t>(count)), limit(height.size());
  for (int i = 0; i < count; ++i) {
    const double time = from + i * grid;
    height[i] = wanted_height(time, phase_.at(time), limit[i]);
  }
  height = smoothed(std::move(height), 10);
  // Where a leg would not reach, the pelvis gives way: the excess, widened by as much as it is then
  // smoothed, so that the limit holds everywhere.
  constexpr int reach = 12;
  std::vector<double> excess(height.size());
  for (std::size_t i = 0; i < excess.size(); ++i) excess[i] = std::max(0.0, height[i] - limit[i]);
  excess = smoothed(largest_near(excess, 3 * reach + 1), reach);
  for (std::size_t i = 0; i < height.size(); ++i) height[i] -= excess[i];
  pelvis_y_ = ApproximatingCurve(from, grid, std::move(height));
}

double SyntheticWalk::phase(double seconds) const {
  const double time = seconds + start_;
  const auto above = std::upper_bound(times_.begin(), times_.end(), time);
  const auto i = std::clamp<std::ptrdiff_t>(above - times_.begin(), 1,
                                            static_cast<std::ptrdiff_t>(times_.size()) - 1);
  const double share = (time - times_[i - 1]) / (times_[i] - times_[i - 1]);
  const double phase = 0.5 * ((i % 2 == 0 ? 1.0 : 0.0) + share);
  return phase >= 1 ? phase - 1 : phase;
}

Vector3d SyntheticWalk::pose(double seconds, std::span<Quaterniond> rotations) const {
  const double time = seconds + start_;
  const double drawn_phase = phase_.at(time);
  upper_body_.pose(drawn_phase, rotations);
  Vector3d pelvis = pelvis_over_ground(time, drawn_phase);
  pelvis.y() = pelvis_y_.at(time);
  for (const Foot foot : {Foot::right, Foot::left}) {
    const int thigh = first_bone(foot);
    const FootState state = foot_at(foot, drawn_phase);
    const Vector3d hip =
        pelvis + rotations[0] * skeleton_.joints[static_cast<std::size_t>(thigh)].offset;
    const LegAngles leg =
        solve_leg(leg_, hip, state.ankle, state.yaw + outward(foot) * style_.knee_out);
    const Quaterniond bent = exponential_map<double>({leg.knee, 0, 0});
    rotations[thigh + thigh_bone] = rotations[0].conjugate() * leg.thigh;
    rotations[thigh + shank_bone] = bent;
    rotations[thigh + foot_bone] = (leg.thigh * bent).conjugate() * about_vertical(state.yaw) *
                                   exponential_map<double>({state.pitch, 0, 0});
  }
  return pelvis;
}

}  // namespace gait
