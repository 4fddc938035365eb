#include "gait/play/cycles/grounded_cycle.h"

#include <algorithm>
#include <cmath>

#include "gait/error.h"
#include "gait/model/body_pose.h"
#include "gait/motion/rotation.h"
#include "gait/motion/smoothing.h"
#include "gait/motion/two_bone.h"

namespace gait {

namespace {

// Steps of half the length lift the foot by more than half.
constexpr double lift_power = 0.5;
// What a swinging foot keeps off the ground at least, metres: other bones than its own may have let
// it sink in.
constexpr double least_clearance = 0.008;
// Where legs are too short the hips come down smoothly, within so much of a cycle.
constexpr double height_window = 0.1;
// Of thigh and shank: a knee bent by 5 degrees, as straight as it gets in walking.
constexpr double longest_reach = 0.999;

// Every value becomes the highest within the window, so that smoothing afterwards takes none away.
void widen_round(std::vector<double>& values) {
  const int count = static_cast<int>(values.size());
  const int reach = std::max(1, static_cast<int>(height_window * count / 2));
  const std::vector<double> narrow = values;
  for (int k = 0; k < count; ++k)
    for (int i = -reach; i <= reach; ++i)
      values[k] = std::max(values[k], narrow[(k + i + count) % count]);
}

// How much a foot swings, 0 to 1, at this part of a cycle since its contact.
double swing(double since_contact) {
  since_contact -= std::floor(since_contact);
  return smoothstep(0.57, 0.67, since_contact) * (1 - smoothstep(0.9, 1.0, since_contact));
}

// In the middle of the swing, when toes that push off have long left the ground.
double rise(double since_contact) {
  since_contact -= std::floor(since_contact);
  return smoothstep(0.6, 0.76, since_contact) * (1 - smoothstep(0.84, 0.98, since_contact));
}

// How much of the body it carries: the other foot the rest.
double carries(double since_contact) {
  since_contact -= std::floor(since_contact);
  return smoothstep(0.0, 0.12, since_contact) * (1 - smoothstep(0.5, 0.62, since_contact));
}

void smooth_round(std::vector<double>& values) {
  const int count = static_cast<int>(values.size());
  const int reach = std::max(1, static_cast<int>(height_window * count / 2));
  const std::vector<double> rough = values;
  for (int k = 0; k < count; ++k) {
    double sum = 0;
    for (int i = -reach; i <= reach; ++i) sum += rough[(k + i + count) % count];
    values[k] = sum / (2 * reach + 1);
  }
}

}  // namespace

GroundedCycle::GroundedCycle(const Body& body, const std::vector<int>& joints)
    : body_(body), joints_(joints), roles_(body_roles(body)) {
  if (!roles_.has_legs())
    throw Error(
        "grounded cycle: expected hips, and thigh, shank and foot of both legs in the body");
  const Leg* legs[] = {&roles_.right, &roles_.left};
  for (int side = 0; side < 2; ++side)
    for (int joint = legs[side]->foot; joint < body.skeleton.size(); ++joint) {
      if (!body.skeleton.is_in_branch(joint, legs[side]->foot)) continue;
      soles_[side].push_back({joint, Eigen::Vector3d::Zero()});
      for (const Eigen::Vector3d& tip : body.skeleton.joints[joint].tips)
        soles_[side].push_back({joint, tip});
    }
}

Eigen::MatrixXd GroundedCycle::with_stride(const Eigen::MatrixXd& walking,
                                           const Eigen::VectorXd& standing, double share) const {
  const int frames = static_cast<int>(walking.cols());
  const Placed still = placed(standing);
  const double still_ground = (lowest(still, soles_[0]) + lowest(still, soles_[1])) / 2;
  std::vector<Placed> steps;
  for (int k = 0; k < frames; ++k) steps.push_back(placed(walking.col(k)));
  // A whole stride stays as it was; in short ones what feet in stance are off the ground would make
  // them slide.
  const Ground ground = ground_under(steps, std::min(1.0, 2 * (1 - share)));

  // Where ankles and soles should be, and how much too long that is for the legs.
  const Leg* legs[] = {&roles_.right, &roles_.left};
  std::vector<Placed> poses;
  std::vector<Eigen::Vector3d> ankles[2];
  std::vector<Eigen::Quaterniond> feet[2];
  std::vector<double> missing(steps.size(), 0.0);
  for (int k = 0; k < frames; ++k) {
    poses.push_back(placed(standing + share * (walking.col(k) - standing)));
    Placed& pose = poses.back();
    const double ground_here = still_ground + share * (ground.height[k] - still_ground);
    for (int side = 0; side < 2; ++side) {
      const int foot = legs[side]->foot;
      feet[side].push_back(slerp(still.world[foot].rotation, steps[k].world[foot].rotation, share));
      // How low the sole lies under the ankle when the foot is turned so.
      pose.local[foot] =
          pose.world[body_.skeleton.joints[foot].parent].rotation.conjugate() * feet[side][k];
      place(pose);
      const double sole = pose.world[foot].place.y() - lowest(pose, soles_[side]);
      Eigen::Vector3d ankle =
          still.world[foot].place + share * (steps[k].world[foot].place - still.world[foot].place);
      const double since_contact = static_cast<double>(k) / frames - 0.5 * side;
      const double power = 1 - (1 - lift_power) * swing(since_contact);
      ankle.y() = ground_here + std::pow(share, power) * ground.clearance[side][k] + sole;
      ankles[side].push_back(ankle);
      missing[k] = std::max(missing[k], too_far(pose, steps[k], *legs[side], ankle));
    }
  }
  // The hips come down as far as the legs are too short: knees never snap straight.
  widen_round(missing);
  smooth_round(missing);

  Eigen::MatrixXd result(walking.rows(), frames);
  std::vector<double> values(static_cast<std::size_t>(walking.rows()));
  for (int k = 0; k < frames; ++k) {
    for (int side = 0; side < 2; ++side)
      reach(poses[k], *legs[side], ankles[side][k] + missing[k] * Eigen::Vector3d::UnitY(),
            feet[side][k]);
    pose_vector<double>(poses[k].local, body_.references, joints_, values);
    result.col(k) = Eigen::Map<const Eigen::VectorXd>(values.data(), walking.rows());
  }
  return result;
}

// How far an ankle has to rise towards the hips to be within reach.
double GroundedCycle::too_far(const Placed& pose, const Placed& step, const Leg& leg,
                              const Eigen::Vector3d& ankle) const {
  const double straight = (pose.world[leg.shank].place - pose.world[leg.thigh].place).norm() +
                          (pose.world[leg.foot].place - pose.world[leg.shank].place).norm();
  const double captured = (step.world[leg.foot].place - step.world[leg.thigh].place).norm();
  const double longest = std::max(longest_reach * straight, captured);
  const Eigen::Vector3d from_thigh = ankle - pose.world[leg.thigh].place;
  const double ahead = std::hypot(from_thigh.x(), from_thigh.z());
  const double lowest_ankle = -std::sqrt(std::max(0.0, longest * longest - ahead * ahead));
  return std::max(0.0, lowest_ankle - from_thigh.y());
}

GroundedCycle::Ground GroundedCycle::ground_under(const std::vector<Placed>& steps,
                                                  double flattened) const {
  const int frames = static_cast<int>(steps.size());
  Ground ground;
  ground.height.resize(steps.size());
  for (int side = 0; side < 2; ++side)
    for (const Placed& step : steps) ground.clearance[side].push_back(lowest(step, soles_[side]));
  // One leg longer than another, where angles of one skeleton meet the bones of another, is no
  // reason to limp.
  double carried[2] = {}, weight[2] = {};
  for (int side = 0; side < 2; ++side)
    for (int k = 0; k < frames; ++k) {
      const double carries_now = carries(static_cast<double>(k) / frames - 0.5 * side);
      carried[side] += carries_now * ground.clearance[side][k];
      weight[side] += carries_now;
    }
  const double uneven = carried[1] / weight[1] - carried[0] / weight[0];
  const double taken = flattened * uneven;
  for (int k = 0; k < frames; ++k) {
    ground.clearance[0][k] += taken / 2;
    ground.clearance[1][k] -= taken / 2;
  }
  for (int k = 0; k < frames; ++k) {
    // Straight legs must bend a lot to give way a little, so the hips follow the foot that carries
    // them, and only while weight passes from foot to foot do both legs give way.
    const double right = carries(static_cast<double>(k) / frames);
    ground.height[k] = right * ground.clearance[0][k] + (1 - right) * ground.clearance[1][k];
  }
  for (int side = 0; side < 2; ++side)
    for (int k = 0; k < frames; ++k) {
      double& clearance = ground.clearance[side][k];
      clearance -= ground.height[k];
      const double swings = swing(static_cast<double>(k) / frames - 0.5 * side);
      clearance *= 1 - flattened * (1 - swings);
      clearance += rise(static_cast<double>(k) / frames - 0.5 * side) *
                   std::max(0.0, least_clearance - clearance);
    }
  return ground;
}

GroundedCycle::Placed GroundedCycle::placed(const Eigen::VectorXd& values) const {
  Placed pose;
  pose.local = body_.references;
  for (std::size_t i = 0; i < joints_.size(); ++i)
    pose.local[joints_[i]] = rotation_from<double>(
        std::span<const double, 3>(values.data() + 3 * i, 3), body_.references[joints_[i]]);
  pose.world.resize(pose.local.size());
  place(pose);
  return pose;
}

// From local rotations to the world's; what lies above the hips is left out.
void GroundedCycle::place(Placed& pose) const {
  for (int joint = roles_.hips; joint < body_.skeleton.size(); ++joint) {
    const Joint& bone = body_.skeleton.joints[joint];
    if (joint == roles_.hips || bone.parent < roles_.hips)
      pose.world[joint] = {pose.local[joint], Eigen::Vector3d::Zero()};
    else
      pose.world[joint] = placed_under(pose.world[bone.parent], pose.local[joint], bone.offset);
  }
}

double GroundedCycle::lowest(const Placed& pose, const std::vector<SolePoint>& sole) const {
  double lowest = INFINITY;
  for (const SolePoint& point : sole)
    lowest = std::min(
        lowest,
        (pose.world[point.joint].place + pose.world[point.joint].rotation * point.offset).y());
  return lowest;
}

// Bends the knee until the ankle is as far from the thigh as it should be, then turns the leg.
void GroundedCycle::reach(Placed& pose, const Leg& leg, const Eigen::Vector3d& ankle,
                          const Eigen::Quaterniond& foot) const {
  const auto parent_of = [&](int joint) { return body_.skeleton.joints[joint].parent; };
  const auto turn = [&](int joint, const Eigen::Quaterniond& by) {  // `by` in the world
    const Eigen::Quaterniond& above = pose.world[parent_of(joint)].rotation;
    pose.local[joint] = (above.conjugate() * by * above * pose.local[joint]).normalized();
    place(pose);
  };
  const Eigen::Vector3d thigh = pose.world[leg.shank].place - pose.world[leg.thigh].place;
  const Eigen::Vector3d shank = pose.world[leg.foot].place - pose.world[leg.shank].place;
  const TwoBones bones{thigh.norm(), shank.norm()};
  Eigen::Vector3d axis = thigh.cross(shank);
  double bent = std::atan2(axis.norm(), thigh.dot(shank));
  // A knee that is bent the wrong way comes back; one that is straight bends about the axis across.
  if (axis.norm() < 1e-4 * bones.upper * bones.lower) {
    axis = Eigen::Vector3d::UnitX();
  } else {
    axis.normalize();
    if (axis.x() < -0.5) axis = -axis, bent = -bent;
  }
  const double bend = bones.bend_at((ankle - pose.world[leg.thigh].place).norm());
  turn(leg.shank, Eigen::Quaterniond(Eigen::AngleAxisd(bend - bent, axis)));
  turn(leg.thigh, turn_between(pose.world[leg.foot].place - pose.world[leg.thigh].place,
                               ankle - pose.world[leg.thigh].place));
  pose.local[leg.foot] = pose.world[parent_of(leg.foot)].rotation.conjugate() * foot;
  place(pose);
}

}  // namespace gait
