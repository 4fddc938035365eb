#include "gait/motion/turns_from_places.h"

#include "gait/motion/rotation.h"

namespace gait {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double shortest = 1e-3;  // metres

bool between(const HumanoidPose& pose, Bone from, Bone to, Vector3d& way) noexcept {
  if (!pose.placed[index_of(from)] || !pose.placed[index_of(to)]) return false;
  way = pose.places[index_of(to)] - pose.places[index_of(from)];
  return way.norm() > shortest;
}

void set(HumanoidPose& pose, Bone bone, const Quaterniond& turn) noexcept {
  pose.turned.set(index_of(bone));
  pose.turns[index_of(bone)] = turn;
}

// The turn that carries +X onto `across` and +Y as near to `up` as it can be.
bool frame(const Vector3d& across, const Vector3d& up, Quaterniond& turn) noexcept {
  const Vector3d x = across.normalized();
  const Vector3d z = x.cross(up.normalized());
  if (z.norm() < 0.05) return false;
  Eigen::Matrix3d axes;
  axes.col(0) = x;
  axes.col(2) = z.normalized();
  axes.col(1) = axes.col(2).cross(x);
  turn = Quaterniond(axes);
  return true;
}

void swing(HumanoidPose& pose, Bone bone, Bone end, Bone above, const Vector3d& at_rest) noexcept {
  Vector3d way;
  if (!pose.turned[index_of(above)] || !between(pose, bone, end, way)) return;
  const Quaterniond& carried = pose.turns[index_of(above)];
  set(pose, bone, turn_between(carried * at_rest, way) * carried);
}

}  // namespace

void turns_from_places(HumanoidPose& pose) noexcept {
  pose.turned.reset();
  const Vector3d up(0, 1, 0), down(0, -1, 0), left(1, 0, 0), right(-1, 0, 0);
  Vector3d across, along;
  Quaterniond turn;
  // The highest joint of the trunk whose place is known.
  Vector3d top = Vector3d::Zero();
  bool has_top = false;
  for (const Bone bone : {Bone::neck, Bone::upper_chest, Bone::chest, Bone::spine, Bone::head})
    if (!has_top && pose.placed[index_of(bone)]) {
      top = pose.places[index_of(bone)];
      has_top = true;
    }
  if (!has_top && between(pose, Bone::right_upper_arm, Bone::left_upper_arm, across)) {
    top = pose.places[index_of(Bone::right_upper_arm)] + across / 2;
    has_top = true;
  }
  if (has_top && between(pose, Bone::right_upper_leg, Bone::left_upper_leg, across)) {
    const Vector3d bottom = pose.places[index_of(Bone::right_upper_leg)] + across / 2;
    along = top - bottom;
    if (along.norm() > shortest && frame(across, along, turn)) set(pose, Bone::hips, turn);
    if (along.norm() > shortest &&
        between(pose, Bone::right_upper_arm, Bone::left_upper_arm, across) &&
        frame(across, along, turn))
      set(pose, Bone::spine, turn);
  }
  const Bone trunk = pose.turned[index_of(Bone::spine)] ? Bone::spine : Bone::hips;
  swing(pose, Bone::neck, Bone::head, trunk, up);
  // The head turns with the neck: no place above it is known.
  if (pose.turned[index_of(Bone::neck)]) set(pose, Bone::head, pose.turns[index_of(Bone::neck)]);
  swing(pose, Bone::left_upper_arm, Bone::left_lower_arm, trunk, left);
  swing(pose, Bone::left_lower_arm, Bone::left_hand, Bone::left_upper_arm, left);
  swing(pose, Bone::right_upper_arm, Bone::right_lower_arm, trunk, right);
  swing(pose, Bone::right_lower_arm, Bone::right_hand, Bone::right_upper_arm, right);
  swing(pose, Bone::left_upper_leg, Bone::left_lower_leg, Bone::hips, down);
  // Some cameras see a foot and no ankle.
  const Bone left_end = pose.placed[index_of(Bone::left_foot)] ? Bone::left_foot : Bone::left_toes;
  swing(pose, Bone::left_lower_leg, left_end, Bone::left_upper_leg, down);
  swing(pose, Bone::right_upper_leg, Bone::right_lower_leg, Bone::hips, down);
  const Bone right_end =
      pose.placed[index_of(Bone::right_foot)] ? Bone::right_foot : Bone::right_toes;
  swing(pose, Bone::right_lower_leg, right_end, Bone::right_upper_leg, down);
}

}  // namespace gait
