// Live body: maps each frame of one performer to a model's body.
//
// Humanoids of any rig are converted by turns and a calibration; named joints and values (the
// project's own form) are used as they are. A joint that stops arriving is held, and counts as
// missing after a while. A joint that has never arrived is missing from the start. Nothing
// allocates after construction.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gait/model/model.h"
#include "gait/motion/heading.h"
#include "gait/motion/humanoid_body.h"
#include "gait/motion/one_euro_filter.h"
#include "gait/motion/sender_calibration.h"
#include "gait/osc/sender_pose.h"

namespace gait::osc {

struct LiveFrame {
  double time = 0;                // of arrival, seconds
  std::span<const float> inputs;  // values of the `in` message
  std::span<const float> pose;    // of the whole body; empty for a model of plain streams
  bool posed = false;             // whether `pose` is of this frame, not `inputs` alone
  Eigen::Vector3f hips = Eigen::Vector3f::Zero();
  float heading = 0;
};

class LiveBody {
 public:
  explicit LiveBody(std::shared_ptr<const Model> model);

  // Takes the next frame as the calibration pose, if it arrives until the time `until`. No effect
  // in the project's own form.
  void calibrate(CalibrationPose pose, double until = 1e300) noexcept {
    calibrate_ = pose;
    calibrate_until_ = until;
  }
  bool calibrated() const noexcept { return calibration_.is_set(); }
  void set_yaw(double radians) noexcept { yaw_ = radians; }
  // Seconds for which an input that stops arriving is held.
  void set_hold(double seconds) noexcept { hold_ = seconds; }
  // Hz at rest of the 1-euro filter; 0: off.
  void set_smoothing(double hertz) noexcept { filter_.set_cutoff(hertz); }
  // For the same rig through another port or program: keeps the calibration, forgets the pose.
  void forget_pose() noexcept;
  // For another performer: forgets everything but the settings.
  void reset() noexcept;
  // Takes over the performer and the calibration from a body of another model.
  void take_over(const LiveBody& other) noexcept;

  // Returns false when the frame holds nothing for this model (values of another count).
  bool take(const CapturedFrame& captured) noexcept;
  const LiveFrame& frame() const noexcept { return frame_; }

  // Whether an input arrived with the last frame, or is still held. `input`: index into the model's
  // inputs.
  bool there(int input) const noexcept;

 private:
  bool take_humanoid(const CapturedFrame& captured) noexcept;
  bool take_named(const CapturedFrame& captured) noexcept;
  bool take_values(const CapturedFrame& captured) noexcept;
  void find_joints(const CapturedFrame& captured) noexcept;
  void finish(const CapturedFrame& captured) noexcept;
  void filter(double time) noexcept;

  std::shared_ptr<const Model> model_;
  std::optional<HumanoidBody> humanoid_;  // none without a body that has legs
  std::vector<Eigen::Quaternionf> references_;
  int hips_ = -1;
  Eigen::Vector3d right_to_left_thigh_ = Eigen::Vector3d::Zero();
  double rest_height_ = 0;  // of the hips, metres

  SenderPose sender_;
  SenderCalibration calibration_;
  std::optional<CalibrationPose> calibrate_;
  double calibrate_until_ = 0;
  struct Standing {
    HumanoidPose sender;
    CalibrationPose pose = CalibrationPose::t;
  };
  std::optional<Standing> standing_;  // as calibrated last
  double yaw_ = 0, hold_ = 0.5;
  OneEuroFilter<double> filter_;
  double filtered_at_ = 0;  // time of the last filtered frame
  CausalHeading<double> heading_;

  HumanoidPose body_pose_;
  std::vector<Eigen::Quaterniond> local_;  // hips in the world
  std::vector<Eigen::Quaternionf> pose_;   // hips with heading out
  std::vector<double> seen_;               // per joint of the body
  std::vector<int> named_of_;              // per joint of the body: index among named ones, -1
  int named_known_ = 0;
  std::vector<int> input_of_;  // per input: its joint, -1: a plain stream
  std::vector<float> inputs_, values_;
  LiveFrame frame_;
};

// The humanoid of a model's body; its usual pose is the model's references.
HumanoidBody humanoid_of(const Body& body);

}  // namespace gait::osc
