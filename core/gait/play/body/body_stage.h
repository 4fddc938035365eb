// A body on stage. It joins measured and synthesised joints (BodyAssembly), smooths them on
// request, moves the body over the ground, and reports what can be seen: places of joints, touches
// of feet, speeds and energy.
//
// The root's path comes from the feet (RootMotion), is the one measured with the pose, or stays on
// the spot. Whole poses have no measured root: their root comes from the feet, and the legs are
// corrected such that feet in stance do not move (FootLock). The stage does not correct synthesised
// outputs, except in the first seconds after whole poses: it then follows the root gently, corrects
// feet in stance or below the ground, and fades that correction. A body that does not
// walk (it stands, or turns on the spot) stays where it is; it stops and starts without a jerk, and
// its path goes on from there. One frame lasts 1 / model.frame_rate, whatever the sender's rate.
//
// Metres, seconds, radians; Y up; values per joint as rotation vectors relative to the references.
// Nothing allocates, throws or locks after construction.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gait/model/model.h"
#include "gait/motion/one_euro_filter.h"
#include "gait/motion/steps.h"
#include "gait/play/body/body_assembly.h"
#include "gait/play/body/foot_lock.h"
#include "gait/play/body/foot_touch.h"
#include "gait/play/body/motion_meter.h"
#include "gait/play/body/root_motion.h"
#include "gait/play/change/glide.h"

namespace gait {

enum class RootFrom {
  feet,  // the path that the feet walk
  keep,  // the measured one; the feet's until one is measured
  still  // on the spot: the feet give its height only
};

struct RootPlace {
  Eigen::Vector3f hips = Eigen::Vector3f::Zero();
  float heading = 0;  // turns +Z towards +X
};

class BodyStage {
 public:
  // Throws Error when the model has no body, or the body no hips and legs.
  explicit BodyStage(std::shared_ptr<const Model> model);

  // Parts that wait for others; see BodyAssembly. False, with nothing changed, when a number is not
  // finite or the size is another.
  bool store_inputs(std::span<const float> values) noexcept;
  bool store_pose(std::span<const float> values) noexcept;
  bool store_root(const RootPlace& root) noexcept;
  // Make the next frame.
  bool show_outputs(std::span<const float> values) noexcept;
  bool show_pose(std::span<const float> values) noexcept;

  // Settings; false, with nothing changed, when a number is not finite.
  void set_delay(int frames) noexcept { assembly_.set_delay(frames); }
  void set_walking(bool walking) noexcept { going_.set(walking ? 1.0f : 0.0f); }
  void set_root(RootFrom from) noexcept { from_ = from; }
  void set_lock(bool lock) noexcept { lock_ = lock; }  // feet that stand; at first it is set
  // Whether to find what can be seen: positions, speeds, energy, touches. At first it is set.
  void set_watched(bool watched) noexcept { watched_ = watched; }
  bool set_heading_rate(float radians_per_second) noexcept;
  bool set_heading(float radians) noexcept;  // from the next frame on, as it was measured
  bool set_place(const Eigen::Vector3f& place) noexcept;  // where its path began, on the ground
  bool set_smooth(float hertz) noexcept;                  // 1-euro filter at rest; 0: off
  bool set_leg_length(float metres) noexcept;             // thigh and shank; 0: the model's

  // Of the last frame.
  std::span<const float> pose() const noexcept;  // 3 per joint of the body
  std::span<const Eigen::Quaternionf> rotations() const noexcept { return pose_; }
  const RootPlace& root() const noexcept { return root_; }
  // Where it is in the world: 3 per joint, then 3 per tip (hands, soles, the top of the head: where
  // bones end without a joint), joint by joint.
  std::span<const float> positions() const noexcept { return positions_; }
  float speed(int joint) const noexcept { return meter_.speed(joint); }          // rad/s
  float energy() const noexcept { return meter_.energy(); }                      // 0 to 1
  bool touched(Foot foot) const noexcept { return feet_[index(foot)].touched; }  // with this frame
  // From the same foot's touch before to this one along the path, metres.
  std::optional<float> stride(Foot foot) const noexcept { return feet_[index(foot)].stride; }

  // Pairs of joints, parent and child, then of joint and tip; a tip's number is its place in
  // positions(), after all joints. Joints above the hips have no bones.
  const std::vector<std::array<int, 2>>& bones() const noexcept { return bones_; }
  const Model& model() const noexcept { return *model_; }
  void reset() noexcept;  // anew from its place; settings stay
  // What comes next belongs to another motion, but the body stays where it is.
  void begin_anew() noexcept;
  // Goes on where another one is, with its settings. False, with nothing changed, when the bodies
  // have not as many joints, inputs and outputs.
  bool take_over(const BodyStage& other) noexcept;

 private:
  struct FootState {
    FootTouch touch;
    bool touched = false, ever = false;
    Eigen::Vector3f place = Eigen::Vector3f::Zero();  // of the walker when it touched
    std::optional<float> stride;
  };
  static std::size_t index(Foot foot) noexcept { return foot == Foot::right ? 0 : 1; }

  bool same_bones(const BodyStage& other) const noexcept;
  void make() noexcept;
  bool may_lock() const noexcept { return lock_ && from_ == RootFrom::feet; }
  void wake_foot_lock() noexcept;
  void move() noexcept;
  void hold_feet() noexcept;
  void watch_feet() noexcept;
  void place_joints() noexcept;

  std::shared_ptr<const Model> model_;
  int hips_;
  float period_, model_leg_;
  std::vector<Eigen::Quaternionf> references_;
  std::vector<Eigen::Vector3f> offsets_;
  std::vector<int> parents_;
  std::vector<bool> above_;  // the hips
  std::vector<std::array<int, 2>> bones_;
  struct Tip {
    std::size_t joint = 0;
    Eigen::Vector3f offset = Eigen::Vector3f::Zero();
  };
  std::vector<Tip> tips_;

  BodyAssembly assembly_;
  DelayedFrames roots_;  // x y z heading
  OneEuroFilter<float> filter_;
  RootMotion motion_;
  FootLock foot_lock_;
  std::vector<std::size_t> leg_joints_;  // that the lock corrects
  MotionMeter meter_;

  RootFrom from_ = RootFrom::feet;
  bool lock_ = true, watched_ = true;
  bool lock_awake_ = false;  // it has something to hold, to lift or to let fade
  Glide going_{1};           // 1 walks, 0 does not
  float heading_rate_ = 0, scale_ = 1;
  Eigen::Vector3f place_ = Eigen::Vector3f::Zero();
  bool started_ = false;
  float gentle_ = 0;  // 1 while whole poses are shown, then falls to 0; see RootMotion
  float heading_ = 0;
  Eigen::Vector3d path_ = Eigen::Vector3d::Zero();    // of the hips, from the place, unscaled
  Eigen::Vector3f walked_ = Eigen::Vector3f::Zero();  // by the feet, whether it may go or not

  std::vector<Eigen::Quaternionf> pose_;
  std::vector<Placement<float>> world_;
  Eigen::VectorXf values_;
  std::vector<float> positions_;
  RootPlace root_;
  std::array<FootState, 2> feet_;
};

}  // namespace gait
