// Foot lock: while a foot stands, the point of it that touches the ground stays where it touched.
//
// A mean of poses, or a pose made from parts, moves a standing foot by millimetres, and a root that
// follows two feet can only follow one at a time. What the root leaves, the leg takes up: the ankle
// is put back along the ground by a correction of its own (two bones and a hinge), the foot keeps
// its orientation in the world. (Kovar, Schreiner, Gleicher 2002, "Footskate cleanup for motion
// capture editing", here without looking ahead.)
//
// A foot stands while its lowest point is near the ground and slow. While it does, the correction
// grows by what the point slips; else it fades, and neither jumps. From `near` to `farthest` it
// lets go little by little: a foot that far off was put somewhere else. Heights are left to the
// root: legs that kept them, near straight as they land, would stretch their knees by 8 degrees for
// that. Only what a gentle root would sink deeper than another is lifted, by a leg that gives as it
// takes the weight. No knee is stretched beyond `straightest`, nor one that is straighter by
// itself; where a leg is too short its foot hovers instead of sliding. No knee is turned faster
// than it goes by itself, or than 6 rad/s, unless its foot would sink: in the air the foot comes
// after.
//
// Units: metres, seconds, radians; Y up. Nothing allocates after construction.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "gait/motion/joint_roles.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/skeleton.h"
#include "gait/play/body/root_motion.h"

namespace gait {

class FootLock {
 public:
  static constexpr float near = 0.08f, farthest = 0.12f;  // m that a foot is put back by
  static constexpr float straightest = 0.14f;             // rad between thigh and shank, 8 degrees

  // `skeleton`, `roles` and rate as the root's: what RootMotion takes can be locked.
  FootLock(const Skeleton& skeleton, const JointRoles& roles, double frame_rate);

  // Corrects thighs, shanks and feet of `pose`, with which `root` was advanced just now to
  // `heading`. `strength`, 0 to 1: how much feet are held at all; at 0 what was corrected fades,
  // and feet that sink are lifted all the same. A pose of another size, or with numbers in hips or
  // legs that are not finite, stays as it is.
  void apply(std::span<Eigen::Quaternionf> pose, const RootMotion& root, float heading = 0,
             float strength = 1) noexcept;
  void reset() noexcept;

  // What a foot is put back by along the ground, in the world, m.
  const Eigen::Vector3f& correction(Foot foot) const noexcept {
    return legs_[index(foot)].correction;
  }
  // Whether nothing is left of corrections: a pose that is neither held nor lifted stays as it is.
  bool idle() const noexcept;
  // Whether the last pose was changed at all.
  bool corrected() const noexcept { return legs_[0].corrected || legs_[1].corrected; }
  // How much a foot is held, 0 to 1.
  float hold(Foot foot) const noexcept { return legs_[index(foot)].hold; }

 private:
  struct Link {  // a joint on the way from the hips to the foot
    int joint = 0;
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
    Placement<float> world;  // from the hips, in the world's axes
  };
  struct LegChain {
    std::vector<Link> links;  // the last one is the foot
    std::size_t thigh = 0, shank = 0;
    Eigen::Vector3f correction = Eigen::Vector3f::Zero();
    Eigen::Vector3f change = Eigen::Vector3f::Zero();  // of the correction, with the last frame
    float hold = 0, lift = 0;
    float clearance = 0;                 // of the sole before it is too deep
    float own_bend = 0, shown_bend = 0;  // of the knee, with the last frame
    bool known = false, corrected = false;
  };
  static std::size_t index(Foot foot) noexcept { return foot == Foot::right ? 0 : 1; }

  static LegChain chain(const Skeleton& skeleton, const Leg& leg, int hips);
  bool usable(std::span<const Eigen::Quaternionf> pose) const noexcept;
  void hold(LegChain& leg, const RootMotion::Sole& sole, float haste,
            float strength) const noexcept;
  static void place(LegChain& leg, std::span<const Eigen::Quaternionf> pose,
                    const Eigen::Quaternionf& hips) noexcept;
  void reach(LegChain& leg, std::span<Eigen::Quaternionf> pose, const Eigen::Quaternionf& hips,
             const Eigen::Vector3f& leftward) noexcept;

  int hips_;
  std::size_t joints_;
  float period_, fading_gain_, release_gain_;
  std::array<LegChain, 2> legs_;  // right, left
};

}  // namespace gait
