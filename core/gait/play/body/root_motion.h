// Root path of a walker from its feet alone (T10 §7.2).
//
// The ground holds the point of a foot that carries the body, and the hips follow by forward
// kinematics. Which point that is rolls forward within a stance: the ankle and toe base after
// contact, the toes from heel-rise on. Pinning the ankle throughout loses up to a third of the
// stride, because the ankle itself travels while the foot rolls over the ball.
//
// A point on the ground moves backward against the hips as fast as the hips go forward, and no
// point of either foot moves backward faster. So the points compete by their backward speed along
// the direction of travel, less for what they are above the lowest and for what they disagree with
// the motion so far, and a soft maximum of them is pinned. As the speeds cross where one point
// takes over from another, a hand-over moves the root by nothing and bends its speed by little.
// The direction of travel itself comes from height alone, over half a second: it may be backward
// or sideways. Ground is at y = 0; the lowest point comes to it within 100 ms, and is never more
// than 9 mm below it, unless the root is gentle.
//
// Pins jolt where poses were mixed or reconstructed, people do not. So the root follows its pinned
// path with limited acceleration, and makes up later for what it could not do at once: the path
// keeps its length. What it lags behind, feet slide and sink; where a FootLock holds and lifts
// them, the legs take it up and the root may be smoother still.
//
// Units: metres, seconds, radians; Y up. Nothing allocates after construction.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "gait/motion/joint_roles.h"
#include "gait/motion/kinematics.h"
#include "gait/motion/skeleton.h"
#include "gait/motion/steps.h"

namespace gait {

class RootMotion {
 public:
  // `skeleton` in metres. Points that may touch the ground: the foot joints, all joints below them
  // and all their tips; two that lie within 5 mm of each other count as one. Throws Error when
  // hips or a thigh, shank or foot is missing or not below the hips, or the rate is not positive.
  RootMotion(const Skeleton& skeleton, const JointRoles& roles, double frame_rate);

  // Moves on by one frame and returns the hips' position. `pose`: local rotations, one per joint of
  // the skeleton; the hips' is their rotation in the world without `heading`, whatever joints are
  // above them. `heading`: turns +Z towards +X. A pose of another size or with numbers that are not
  // finite leaves the root where it is.
  Eigen::Vector3f advance(std::span<const Eigen::Quaternionf> pose, float heading = 0) noexcept;

  // Starts anew: the next frame stands with its hips above or below `place`, lowest point on the
  // ground.
  void reset(const Eigen::Vector3f& place = Eigen::Vector3f::Zero()) noexcept;

  // How gently the root follows its pins, 0 (at first) to 1, and how late; settable at any frame. A
  // FootLock must then correct the legs: above 0, feet sink by up to 5 cm until it lifts them.
  void set_gentle(float gentle) noexcept { gentle_ = gentle; }
  // Whether it is gentle, or a foot is still in the ground since it was.
  bool sunk() const noexcept { return sunk_; }

  Eigen::Vector3f position() const noexcept { return position_.cast<float>(); }
  Eigen::Vector3f velocity() const noexcept { return velocity_; }  // of the hips, m/s

  // How much of the pin lies on this foot, 0 to 1: 1 while it alone carries the body.
  float share_of(Foot foot) const noexcept;

  // A foot's lowest point in the world: how high it is, and how it moved with the last frame.
  struct Sole {
    float height = 0;                                  // above the ground, m
    Eigen::Vector3f moved = Eigen::Vector3f::Zero();   // m
    Eigen::Vector3f pinned = Eigen::Vector3f::Zero();  // the same had the root followed at once
  };
  Sole sole(Foot foot) const noexcept;

 private:
  struct Link {                   // a joint on the way from the hips to a toe
    int joint = -1, parent = -1;  // parent: index of a link; -1 for the hips themselves
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
    Placement<float> world;  // from the hips, in the world's axes
  };
  struct Point {  // may touch the ground
    Foot foot = Foot::right;
    int link = 0;
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();  // from the link's joint, in its frame
    Eigen::Vector3f place = Eigen::Vector3f::Zero(), before = Eigen::Vector3f::Zero();
    Eigen::Vector3f speed = Eigen::Vector3f::Zero();  // against the hips
    // The same without the noise of single frames, for the choice only.
    Eigen::Vector3f smoothed = Eigen::Vector3f::Zero();
    float weight = 0, weight_before = 0;  // share of the pin
  };

  int add_link(const Skeleton& skeleton, int joint, int hips);
  void add_points(const Skeleton& skeleton, int hips, int foot_joint, Foot foot);
  bool place_points(std::span<const Eigen::Quaternionf> pose, float heading) noexcept;
  void update_speeds() noexcept;
  void update_travel() noexcept;
  void weigh_points() noexcept;
  void move() noexcept;
  void follow() noexcept;
  void stay_above_ground() noexcept;
  bool starting() const noexcept;

  int joints_;
  float period_, speed_gain_, travel_gain_, height_gain_, recovery_gain_;
  float gentle_gain_, gentle_recovery_gain_;
  std::vector<Link> links_;
  std::vector<Point> points_;
  int frames_ = 0;                                    // since the (re)start
  float lowest_ = 0;                                  // height of the lowest point against the hips
  Eigen::Vector3f travel_ = Eigen::Vector3f::Zero();  // slow velocity, by height alone
  float walking_ = 0;  // 0 standing, 1 walking: how much travel_ is to be believed
  float gentle_ = 0;
  bool sunk_ = false;
  // By the pins, and as shown. Places in double: an hour's walk is kilometres.
  Eigen::Vector3f pinned_velocity_ = Eigen::Vector3f::Zero(), velocity_ = Eigen::Vector3f::Zero();
  Eigen::Vector3d pinned_ = Eigen::Vector3d::Zero(), position_ = Eigen::Vector3d::Zero();
  // With the last frame.
  Eigen::Vector3f pinned_moved_ = Eigen::Vector3f::Zero(), moved_ = Eigen::Vector3f::Zero();
};

}  // namespace gait
