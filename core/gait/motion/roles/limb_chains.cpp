#include "gait/motion/roles/limb_chains.h"

#include <algorithm>
#include <cmath>

#include "gait/motion/kinematics.h"

namespace gait {
namespace {

constexpr int most_poses = 16;
// Chains as long as each other belong together; captured bodies differ by a few percent.
constexpr double like_lengths = 0.8;
// A leg from the hip is 0.53 of a body's height, an arm 0.44 with its hand, a finger 0.05.
constexpr double shortest_limb = 0.25;  // of what lies between the farthest joints
// How straight legs lead away from the rest of the body: the cosine.
constexpr double leads_away = 0.5;
constexpr double foot_angle = 0.82;    // cosine of 35 degrees: where a chain bends to a foot
constexpr double collar_share = 0.75;  // a collar bone is shorter than an upper arm
constexpr double hip_distance = 0.04;  // of a leg's length, between the two first joints of legs

double size_of(const RigPoses& rig) {
  double size = 0;
  for (int a = 0; a < rig.skeleton().size(); ++a)
    for (int b = a + 1; b < rig.skeleton().size(); b += 1 + rig.skeleton().size() / 64)
      size = std::max(size, (rig.place(0, a) - rig.place(0, b)).norm());
  return size;
}

double length(const RigPoses& rig, const LimbPair& pair) {
  return (rig.reach(pair.chains[0].front()) + rig.reach(pair.chains[1].front())) / 2;
}

// Pairs of like chains of at least `joints` joints that leave the same joint, the longest first.
// `taken`: one per joint, those that belong to other limbs; may be empty.
std::vector<LimbPair> like_pairs(const RigPoses& rig, std::size_t joints,
                                 const std::vector<bool>& taken) {
  constexpr std::size_t most_limbs = 16, most_pairs = 40;  // beyond these are fringes
  const double shortest = shortest_limb * size_of(rig);
  std::vector<LimbPair> pairs;
  for (int parent = 0; parent < rig.skeleton().size(); ++parent) {
    std::vector<std::vector<int>> limbs;
    for (const int child : rig.children(parent)) {
      if ((!taken.empty() && taken[child]) || rig.reach(child) <= 0 || rig.reach(child) < shortest)
        continue;
      std::vector<int> chain = rig.chain(child);
      if (chain.size() >= joints) limbs.push_back(std::move(chain));
      if (limbs.size() == most_limbs) break;
    }
    for (std::size_t a = 0; a < limbs.size(); ++a)
      for (std::size_t b = a + 1; b < limbs.size(); ++b) {
        const double one = rig.reach(limbs[a].front()), other = rig.reach(limbs[b].front());
        if (std::min(one, other) >= like_lengths * std::max(one, other))
          pairs.push_back({parent, {limbs[a], limbs[b]}});
      }
  }
  std::ranges::stable_sort(
      pairs, [&](const LimbPair& a, const LimbPair& b) { return length(rig, a) > length(rig, b); });
  if (pairs.size() > most_pairs) pairs.resize(most_pairs);
  return pairs;
}

// 1 where both chains lead straight away from all other joints, -1 where they lead back to them.
double away_from_rest(const RigPoses& rig, const LimbPair& pair) {
  const Skeleton& skeleton = rig.skeleton();
  double sum = 0;
  for (int pose = 0; pose < rig.poses(); ++pose) {
    // The median: joints that only carry the body may lie anywhere.
    std::array<std::vector<double>, 3> others;
    for (int joint = 0; joint < skeleton.size(); ++joint)
      if (joint != pair.parent && !skeleton.is_in_branch(joint, pair.chains[0].front()) &&
          !skeleton.is_in_branch(joint, pair.chains[1].front()))
        for (int axis = 0; axis < 3; ++axis) others[axis].push_back(rig.place(pose, joint)[axis]);
    if (others[0].empty()) return -1;
    Eigen::Vector3d rest;
    for (int axis = 0; axis < 3; ++axis) {
      const auto middle =
          others[axis].begin() + static_cast<std::ptrdiff_t>(others[axis].size() / 2);
      std::nth_element(others[axis].begin(), middle, others[axis].end());
      rest[axis] = *middle;
    }
    Eigen::Vector3d way = Eigen::Vector3d::Zero();
    for (const std::vector<int>& chain : pair.chains)
      way += rig.place(pose, chain.back()) - rig.place(pose, chain.front());
    const Eigen::Vector3d back = rest - rig.place(pose, pair.parent);
    const double lengths = way.norm() * back.norm();
    if (lengths > 0) sum -= way.dot(back) / lengths;
  }
  return sum / rig.poses();
}

// How well three joints stand for the ends and the middle of a limb: two long bones alike.
double as_limb(const RigPoses& rig, int upper, int middle, int end) {
  const double one = rig.distance(upper, middle), other = rig.distance(middle, end);
  if (one <= 0 || other <= 0) return 0;
  return (one + other) * std::exp(-3 * std::abs(std::log(one / other)));
}

// Where a leg's chain bends forward to the foot; its last joint when it never does.
std::size_t ankle_of(const RigPoses& rig, const std::vector<int>& chain, std::size_t thigh) {
  for (std::size_t i = thigh + 2; i < chain.size(); ++i) {
    double cosine = 0;
    bool leads_on = true;
    for (int pose = 0; pose < rig.poses(); ++pose) {
      const Eigen::Vector3d here = rig.place(pose, chain[i]);
      const Eigen::Vector3d shank = here - rig.place(pose, chain[i - 1]);
      const auto tip = rig.tip(pose, chain[i]);
      if (i + 1 == chain.size() && !tip) leads_on = false;
      const Eigen::Vector3d on = i + 1 < chain.size()
                                     ? Eigen::Vector3d(rig.place(pose, chain[i + 1]) - here)
                                     : tip.value_or(here) - here;
      const double lengths = shank.norm() * on.norm();
      cosine += lengths > 0 ? shank.dot(on) / lengths : 1;
    }
    if (leads_on && cosine / rig.poses() < foot_angle) return i;
  }
  return chain.size() - 1;
}

LimbJoints joints_of_leg(const RigPoses& rig, const std::vector<int>& chain, std::size_t thigh) {
  const std::size_t ankle = ankle_of(rig, chain, thigh);
  std::size_t knee = thigh + 1;
  for (std::size_t i = thigh + 2; i < ankle; ++i)
    if (as_limb(rig, chain[thigh], chain[i], chain[ankle]) >
        as_limb(rig, chain[thigh], chain[knee], chain[ankle]))
      knee = i;
  return {chain[thigh], chain[knee], chain[ankle],
          ankle + 1 < chain.size() ? chain[ankle + 1] : -1};
}

}  // namespace

RigPoses::RigPoses(const Clip& clip)
    : skeleton_(&clip.skeleton),
      children_(clip.skeleton.joints.size()),
      reach_(clip.skeleton.joints.size(), 0) {
  const std::size_t joints = clip.skeleton.joints.size();
  Clip rest;
  rest.skeleton = clip.skeleton;
  rest.resize(1);
  const Clip& shown = clip.frames() > 0 ? clip : rest;
  const int count = std::min(most_poses, shown.frames());
  std::vector<Eigen::Quaterniond> world(joints);
  for (int pose = 0; pose < count; ++pose) {
    const int frame = static_cast<int>((pose + 0.5) * shown.frames() / count);
    auto& places = places_.emplace_back(joints);
    auto& tips = tips_.emplace_back();
    forward_kinematics(shown.skeleton, shown.pose(frame), shown.translation(frame), world, places);
    for (std::size_t joint = 0; joint < joints; ++joint) {
      Eigen::Vector3d longest = Eigen::Vector3d::Zero();
      for (const Eigen::Vector3d& tip : shown.skeleton.joints[joint].tips)
        if (tip.norm() > longest.norm()) longest = tip;
      tips.push_back(places[joint] + world[joint] * longest);
    }
  }
  for (int joint = skeleton_->size() - 1; joint >= 0; --joint) {
    if (const auto end = tip(0, joint))
      reach_[joint] = std::max(reach_[joint], (*end - place(0, joint)).norm());
    if (const int parent = skeleton_->joints[joint].parent; parent >= 0) {
      children_[parent].insert(children_[parent].begin(), joint);
      reach_[parent] = std::max(reach_[parent], reach_[joint] + bone(joint));
    }
  }
}

std::optional<Eigen::Vector3d> RigPoses::tip(int pose, int joint) const {
  if (skeleton_->joints[joint].tips.empty()) return std::nullopt;
  return tips_[pose][joint];
}

double RigPoses::distance(int a, int b) const {
  double sum = 0;
  for (int pose = 0; pose < poses(); ++pose) sum += (place(pose, a) - place(pose, b)).norm();
  return sum / poses();
}

double RigPoses::bone(int joint) const {
  const int parent = skeleton_->joints[joint].parent;
  return parent < 0 ? 0 : (place(0, joint) - place(0, parent)).norm();
}

std::vector<int> RigPoses::chain(int joint) const {
  std::vector<int> chain{joint};
  while (!children_[joint].empty()) {
    joint = *std::ranges::max_element(children_[joint], {},
                                      [&](int child) { return reach_[child] + bone(child); });
    chain.push_back(joint);
  }
  return chain;
}

std::optional<LimbPair> find_leg_chains(const RigPoses& rig) {
  std::optional<LimbPair> best;
  double longest = 0;
  for (LimbPair& pair : like_pairs(rig, 3, {})) {
    const double away = away_from_rest(rig, pair);
    if (away < leads_away || length(rig, pair) * away <= longest) continue;
    longest = length(rig, pair) * away;
    best = std::move(pair);
  }
  return best;
}

std::optional<LimbPair> find_arm_chains(const RigPoses& rig, const std::vector<bool>& taken) {
  std::optional<LimbPair> best;
  double longest = 0;
  for (LimbPair& pair : like_pairs(rig, 2, taken)) {
    // Legs below a chain make it the trunk.
    const bool holds_legs = std::ranges::any_of(pair.chains, [&](const std::vector<int>& chain) {
      for (int joint = 0; joint < rig.skeleton().size(); ++joint)
        if (taken[joint] && rig.skeleton().is_in_branch(joint, chain.front())) return true;
      return false;
    });
    if (holds_legs || length(rig, pair) <= longest) continue;
    longest = length(rig, pair);
    best = std::move(pair);
  }
  return best;
}

std::array<LimbJoints, 2> joints_of_legs(const RigPoses& rig, const LimbPair& legs) {
  // Mounts in the middle of the body come before the thighs.
  std::size_t thigh = 0;
  const std::size_t last = std::min(legs.chains[0].size(), legs.chains[1].size()) - 3;
  while (thigh < last && rig.distance(legs.chains[0][thigh], legs.chains[1][thigh]) <
                             hip_distance * length(rig, legs))
    ++thigh;
  return {joints_of_leg(rig, legs.chains[0], thigh), joints_of_leg(rig, legs.chains[1], thigh)};
}

LimbJoints joints_of_arm(const RigPoses& rig, const std::vector<int>& whole) {
  // Fingers leave the chain; joints on the spot of the one before are its mounts.
  std::vector<int> chain;
  for (const int joint : whole) {
    if (!chain.empty() && rig.distance(chain.back(), joint) < 1e-6 * rig.reach(whole.front()))
      chain.back() = joint;
    else
      chain.push_back(joint);
    if (rig.children(joint).size() >= 3 && chain.size() >= 3) break;
  }
  const auto end = [&](std::size_t i) { return i < chain.size() ? chain[i] : -1; };
  std::size_t arm = 0;
  if (chain.size() >= 3 &&
      rig.distance(chain[0], chain[1]) < collar_share * rig.distance(chain[1], chain[2]))
    arm = 1;
  std::size_t forearm = arm + 1, hand = arm + 2;
  double best = 0;
  for (std::size_t middle = arm + 1; middle < chain.size(); ++middle)
    for (std::size_t last = middle + 1; last < chain.size(); ++last)
      if (const double fits = as_limb(rig, chain[arm], chain[middle], chain[last]); fits > best)
        best = fits, forearm = middle, hand = last;
  return {arm == 1 ? chain[0] : -1, chain[arm], end(forearm), end(hand)};
}

double first_is_left(const RigPoses& rig, const std::array<LimbJoints, 2>& legs) {
  double feet = 0, knees = 0;
  for (int pose = 0; pose < rig.poses(); ++pose) {
    Eigen::Vector3d toes = Eigen::Vector3d::Zero(), knee = toes, down = toes;
    for (const auto& [thigh, shank, foot, toe] : legs) {
      const Eigen::Vector3d hip = rig.place(pose, thigh), ankle = rig.place(pose, foot);
      const Eigen::Vector3d tip =
          toe >= 0 ? rig.place(pose, toe) : rig.tip(pose, foot).value_or(ankle);
      toes += tip - ankle;
      const Eigen::Vector3d leg = (ankle - hip).normalized(), at = rig.place(pose, shank) - hip;
      knee += at - at.dot(leg) * leg;
      down += leg;
    }
    // Facing forward with the legs down, left is the forward direction turned about the way up.
    const Eigen::Vector3d across = rig.place(pose, legs[0][0]) - rig.place(pose, legs[1][0]);
    feet += across.dot((-down).cross(toes));
    knees += across.dot((-down).cross(knee));
  }
  return feet != 0 ? feet : knees;
}

}  // namespace gait
