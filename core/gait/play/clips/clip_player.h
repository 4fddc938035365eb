// Clip player: a walk on a model's body, frame by frame at the model's rate, at any speed, from any
// moment, once or in a loop.
//
// Between the walk's own frames rotations go by SLERP and the path linearly; a moment within a
// thousandth of a frame is that frame, to the bit. Where a loop goes back the path goes on: the
// body walks on from where it is, in its own direction. Units: metres, seconds, radians.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "gait/model/body_motion.h"
#include "gait/model/model.h"

namespace gait {

struct PlayedFrame {
  double time = 0;                                 // in the walk, seconds
  std::span<const float> inputs;                   // rotation vectors of the input joints
  std::span<const float> pose;                     // of all joints of the body
  Eigen::Vector3f hips = Eigen::Vector3f::Zero();  // in the world, path and all
  float heading = 0;
  int label = -1;                    // index into the walk's labels, -1: none holds
  bool right = false, left = false;  // whether that foot touched since the frame before
};

class ClipPlayer {
 public:
  // Throws Error when the model has no body.
  explicit ClipPlayer(std::shared_ptr<const Model> model);

  // Plays another walk, from its beginning; null: none. Its poses are of this model's body: false,
  // with nothing changed, when it has another number of joints. Rate and loop stay.
  bool set_motion(std::shared_ptr<const BodyMotion> motion) noexcept;
  const BodyMotion* motion() const noexcept { return motion_.get(); }

  // How fast time goes by: 1 as captured, below 0 backwards.
  void set_speed(double speed) noexcept { speed_ = speed; }
  // The whole walk, or not at all.
  void set_loop(bool on) noexcept;
  // Seconds, half open. What lies outside the walk is cut off; where less than a frame is left, the
  // whole walk loops.
  void set_loop(double begin, double end) noexcept;
  // The next frame is that of this moment (held within the walk), the path the walk's own again.
  void go_to(double seconds) noexcept;

  // Moves on by a frame of the model. False, with nothing changed, at the end of a walk that does
  // not loop, and without a walk.
  bool advance() noexcept;
  const PlayedFrame& frame() const noexcept { return frame_; }
  // The label of the present frame; empty when none holds.
  std::string_view label() const noexcept;

 private:
  struct Place {
    Eigen::Vector3d hips = Eigen::Vector3d::Zero();
    double heading = 0;
  };
  struct Range {
    double begin = 0, end = 0;
  };

  Range loop() const noexcept;
  double last() const noexcept;  // moment of the last frame
  bool move(double step) noexcept;
  void jump(double from, double to) noexcept;
  void note_contacts(double from, double to, bool with_from) noexcept;
  Place place_in_walk(double time) const noexcept;
  Place place_in_world(double time) const noexcept;
  void make_frame() noexcept;

  std::shared_ptr<const Model> model_;
  std::vector<Eigen::Quaternionf> references_;
  std::shared_ptr<const BodyMotion> motion_;

  double speed_ = 1;
  bool looping_ = false;
  Range wanted_loop_;  // empty: everything
  double time_ = 0;
  bool begun_ = false;  // the frame at time_ has been made
  Place path_;          // where the walk's own origin lies, and its turn
  std::vector<Eigen::Quaternionf> rotations_;
  std::vector<float> inputs_, pose_;
  PlayedFrame frame_;
};

}  // namespace gait
