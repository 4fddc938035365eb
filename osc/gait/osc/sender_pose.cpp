#include "gait/osc/sender_pose.h"

#include <algorithm>

#include "gait/motion/turns_from_places.h"
#include "gait/osc/forms.h"

namespace gait::osc {

namespace {

Eigen::Quaterniond rotation_of(const std::array<float, 4>& q) {
  return Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized();
}
Eigen::Vector3d place_of(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

// Bridges send bones relative to their parents or in the world, depending on a setting of the
// program behind them that they do not send. A head more than half a metre from the origin is not
// relative to its parent; a nearer one may still be in the world.
bool told_in_world(const HumanoidPose& told) {
  constexpr double longest_neck = 0.5;
  for (const Bone bone : {Bone::head, Bone::left_lower_leg, Bone::right_lower_leg}) {
    const double limit = bone == Bone::head ? longest_neck : 0.7;
    if (told.placed[index_of(bone)]) return told.places[index_of(bone)].norm() > limit;
  }
  return false;
}

// The bone at the end of a limb's bone; -1: it is not of a limb.
int limb_end(int bone) {
  switch (static_cast<Bone>(bone)) {
    case Bone::neck:
    case Bone::left_upper_arm:
    case Bone::left_lower_arm:
    case Bone::right_upper_arm:
    case Bone::right_lower_arm:
    case Bone::left_upper_leg:
    case Bone::left_lower_leg:
    case Bone::right_upper_leg:
    case Bone::right_lower_leg:
      return bone + 1;
    default:
      return -1;
  }
}

}  // namespace

bool SenderPose::take(const CapturedFrame& frame) noexcept {
  if (frame.form == MocapForm::none) return false;
  const FormSpace space = facts_of(frame.form).space;
  if (space == FormSpace::own) return false;
  const bool left_handed = space == FormSpace::unity;
  const std::array<float, 3> nowhere{};
  for (std::size_t bone = 1; bone < humanoid_bones; ++bone)
    if (frame.placed[bone] && frame.places[bone] != nowhere) places_known_ = true;
  for (std::size_t bone = 0; bone < humanoid_bones; ++bone) {
    if (frame.rotated[bone]) {
      const Eigen::Quaterniond q = rotation_of(frame.rotations[bone]);
      told_.turns[bone] = left_handed ? mirrored(q) : q;
      told_.turned.set(bone);
    }
    // Many senders have no places and send zeros: these are ignored. When other places are known, a
    // joint at zero is at its parent.
    const bool told =
        frame.placed[bone] && (frame.places[bone] != nowhere || (bone > 0 && places_known_));
    if (told) {
      const Eigen::Vector3d p = place_of(frame.places[bone]);
      told_.places[bone] = left_handed ? mirrored(p) : p;
      told_.placed.set(bone);
      place_seen_[bone] = frame.time;
    }
    if (frame.rotated[bone]) seen_[bone] = frame.time;
  }
  if (frame.root_told && space == FormSpace::unity) {
    root_ = mirrored(place_of(frame.root));
    root_rotation_ = mirrored(rotation_of(frame.root_rotation));
  }
  in_world_ = in_world_ || space == FormSpace::world ||
              (space == FormSpace::judged && told_in_world(told_));
  if (space == FormSpace::camera)
    take_places(frame);
  else if (in_world_)
    take_world();
  else
    take_local();
  return true;
}

void SenderPose::take_local() noexcept {
  local_ = told_;
  world_.turned = told_.turned;
  world_.placed.reset();
  for (int bone = 0; bone < humanoid_bones; ++bone) {
    const auto at = static_cast<std::size_t>(bone);
    if (!told_.turned[at]) continue;
    const int above = told_.turned_above(bone);
    const Eigen::Quaterniond base = above < 0 ? root_rotation_ : world_.turns[above];
    world_.turns[at] = (base * told_.turns[at]).normalized();
    // A place is known when all places down from the root are.
    if (above >= 0 && told_.placed[at] && world_.placed[above]) {
      world_.placed.set(at);
      world_.places[at] = world_.places[above] + base * told_.places[at];
    } else if (above < 0 && (told_.placed[at] || !root_.isZero())) {
      world_.placed.set(at);
      world_.places[at] = root_ + base * told_.places[at];
    }
  }
}

void SenderPose::take_world() noexcept {
  world_ = told_;
  local_.turned = told_.turned;
  local_.placed.reset();
  for (int bone = 0; bone < humanoid_bones; ++bone) {
    const auto at = static_cast<std::size_t>(bone);
    if (!told_.turned[at]) continue;
    local_.turns[at] = told_.local_turn(bone);
    if (!told_.locally_placed(bone)) continue;
    local_.placed.set(at);
    local_.places[at] = told_.local_place(bone);
  }
}

// Cameras differ in the directions of X and Y. The head is above the hips, and a performer who
// faces the camera (which looks along its Z) has the right hand on the side of +X in a right-handed
// frame.
void SenderPose::judge_axes() noexcept {
  const auto known = [this](Bone bone) { return told_.placed[index_of(bone)]; };
  const auto at = [this](Bone bone) { return told_.places[index_of(bone)]; };
  if (!known(Bone::head) || !known(Bone::left_upper_leg) || !known(Bone::right_upper_leg) ||
      !known(Bone::left_upper_arm) || !known(Bone::right_upper_arm))
    return;
  y_sign_ = at(Bone::head).y() < at(Bone::left_upper_leg).y() ? -1 : 1;
  const bool right_on_plus_x = at(Bone::right_upper_arm).x() > at(Bone::left_upper_arm).x();
  x_sign_ = right_on_plus_x ? 1 : -1;
  axes_judged_ = true;
}

void SenderPose::take_places(const CapturedFrame& frame) noexcept {
  if (!axes_judged_) judge_axes();
  world_.clear();
  world_.placed = told_.placed;
  for (std::size_t bone = 0; bone < humanoid_bones; ++bone)
    if (told_.placed[bone])
      world_.places[bone] = told_.places[bone].cwiseProduct(Eigen::Vector3d(x_sign_, y_sign_, 1));
  if (!axes_judged_) return;
  turns_from_places(world_);
  // These cameras have no joint for the hips: it is put between the thighs.
  constexpr auto hips = static_cast<std::size_t>(index_of(Bone::hips));
  if (world_.turned[hips]) {
    world_.placed.set(hips);
    world_.places[hips] = (world_.places[index_of(Bone::left_upper_leg)] +
                           world_.places[index_of(Bone::right_upper_leg)]) /
                          2;
  }
  // A bone is known as long as both of its ends are.
  for (int bone = 0; bone < humanoid_bones; ++bone) {
    const auto here = static_cast<std::size_t>(bone);
    if (!world_.turned[here]) continue;
    seen_[here] = frame.time;
    for (const int end : {bone, limb_end(bone)})
      if (end >= 0 && told_.placed[end]) seen_[here] = std::min(seen_[here], place_seen_[end]);
  }
  local_.clear();
  local_.turned = world_.turned;
  for (int bone = 0; bone < humanoid_bones; ++bone)
    if (world_.turned[static_cast<std::size_t>(bone)])
      local_.turns[static_cast<std::size_t>(bone)] = world_.local_turn(bone);
  local_.places[hips] = world_.places[hips];
  local_.placed[hips] = world_.placed[hips];
}

}  // namespace gait::osc
